# SPDX-License-Identifier: BSD-2-Clause
"""A pin on a plate that slides below it: two boxes of hexahedra, as a flat deck."""
import numpy as np

PLATE, PIN = (4, 4, 1), (2, 2, 2)  # cells of size one
BEGIN = (1.0, 1.0)  # corner of the pin on the plate


def box(cells, origin, first_node, first_cell):
    """Returns node lines, element lines, and node numbers by place, [x, y, z]."""
    nx, ny, nz = cells
    place = np.arange((nx + 1) * (ny + 1) * (nz + 1)).reshape(nx + 1, ny + 1, nz + 1) + first_node
    nodes = [
        f"{place[i, j, k]}, {origin[0] + i}, {origin[1] + j}, {origin[2] + k}"
        for i, j, k in np.ndindex(nx + 1, ny + 1, nz + 1)
    ]
    elements = []
    for number, (i, j, k) in enumerate(np.ndindex(nx, ny, nz), first_cell):
        low = [place[i, j, k], place[i + 1, j, k], place[i + 1, j + 1, k], place[i, j + 1, k]]
        high = [one + 1 for one in low]  # the last index counts first
        elements.append(", ".join(map(str, [number, *low, *high])))
    return nodes, elements, place


def deck(law, steps, swapped=False, gap=0.0, pair=""):
    """Returns a deck: the plate is held below, the pin across at its back and pressed there. `law`:
    cards after *SURFACE INTERACTION; `swapped`: the plate is the slave."""
    plate_nodes, plate, at_plate = box(PLATE, (0, 0, 0), 1, 1)
    pin_nodes, pin, at_pin = box(PIN, (*BEGIN, PLATE[2] + gap), 1001, 1001)
    sets = {
        "PLATE_BOTTOM": at_plate[:, :, 0],
        "RUBBED": at_plate[:, :, -1],
        "EDGE": at_plate[0, :, :],
        "PIN_BACK": at_pin[:, :, -1],
    }
    lines = ["*NODE, NSET=PLATE", *plate_nodes, "*NODE, NSET=PIN", *pin_nodes]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=PLATE", *plate, "*ELEMENT, TYPE=C3D8, ELSET=PIN", *pin]
    for name, members in sets.items():
        lines += [f"*NSET, NSET={name}", *map(str, members.ravel())]
    # Cells of the pin count up in z first: the lower ones are odd.
    lower = [1001 + number for number in range(0, len(pin), PIN[2])]
    upper = [number + 1 for number in lower]
    lines += ["*SURFACE, NAME=PIN_FACE", *(f"{number}, S1" for number in lower)]
    lines += ["*SURFACE, NAME=BACK", *(f"{number}, S2" for number in upper)]
    lines += ["*SURFACE, NAME=PLATE_FACE", "PLATE, S2"]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "1000., 0.3", "*DENSITY", "1."]
    lines += ["*SOLID SECTION, ELSET=PLATE, MATERIAL=STEEL"]
    lines += ["*SOLID SECTION, ELSET=PIN, MATERIAL=STEEL"]
    lines += ["*SURFACE INTERACTION, NAME=RUB", *law.split("\n")[:-1]]
    lines += [f"*CONTACT PAIR, INTERACTION=RUB, TYPE=SURFACE TO SURFACE{pair}"]
    lines += ["PLATE_FACE, PIN_FACE" if swapped else "PIN_FACE, PLATE_FACE"]
    lines += ["*BOUNDARY", "PLATE_BOTTOM, 1, 3", "PIN_BACK, 1, 2"]
    return "\n".join(lines) + "\n" + steps


def motion(name="PLATE", speed=4.0, a=(0, 0, 0), b=(0, 0, 1)):
    """Returns the card of a turn of these nodes about the line from a to b."""
    fields = ", ".join(str(float(one)) for one in (speed, *a, *b))
    return f"*MOTION, ROTATION, TYPE=VELOCITY\n{name}, {fields}\n"


def turn(angle, centre, law="*FRICTION\n0.3, 5000.\n", finite=False):
    """Returns a deck of CalculiX in which the bottom of the plate is turned about an axis along z
    by an angle (rad, to first order or as a whole), and that asks for modes."""
    _, _, at = box(PLATE, (0, 0, 0), 1, 1)
    lines = ["*STEP", "*STATIC", "*DSLOAD", "BACK, P, 2.", "*BOUNDARY"]
    inwards, along = (np.cos(angle) - 1, np.sin(angle)) if finite else (0.0, angle)
    for i, j in np.ndindex(PLATE[0] + 1, PLATE[1] + 1):
        x, y = i - centre[0], j - centre[1]
        lines.append(f"{at[i, j, 0]}, 1, 1, {inwards * x - along * y!r}")
        lines.append(f"{at[i, j, 0]}, 2, 2, {along * x + inwards * y!r}")
    lines += ["*END STEP", "*STEP, PERTURBATION", "*FREQUENCY", "12", "*END STEP"]
    return deck(law, "\n".join(lines) + "\n")
