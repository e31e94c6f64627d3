# SPDX-License-Identifier: BSD-2-Clause
"""Two arms on a block: as an assembly of Abaqus, with files of its parts, and as a flat deck.

The second arm is the first one turned by 90° about the axis (1/2, 1/2, z) of the block. The flat
deck has the numbers and coordinates of its own, computed here.
"""
import numpy as np

TURN = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
MIDDLE = np.array([0.5, 0.5, 0.0])
# Corners of a cell, and its faces as CalculiX numbers them: the face at the lower and upper end of
# each axis.
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
FACES = {(0, 0): 6, (0, 1): 4, (1, 0): 3, (1, 1): 5, (2, 0): 1, (2, 1): 2}
STEEL = "*Material, name=Steel\n*Elastic\n210000., 0.3\n*Density\n7.8e-9,\n"
WOOD = """*MATERIAL, NAME=Wood
*Elastic, type=ENGINEERING CONSTANTS
12000., 900., 600., 0.3, 0.4, 0.35, 800., 700.
100.
*density
6.e-10
"""


class Box:
    """A box of hexahedra with its lower corner at the origin: nodes by number from 1, elements, and
    the nodes and elements at its sides (axis, end)."""

    def __init__(self, size, cells):
        self.nodes, self.elements, self.sides = {}, {}, {}
        shape = np.array(cells)
        for index in np.ndindex(*(shape + 1)):
            self.nodes[self._number(index, shape)] = np.array(index) / shape * np.array(size)
        for count, index in enumerate(np.ndindex(*shape), 1):
            corners = [self._number(np.add(index, corner), shape) for corner in CORNERS]
            self.elements[count] = corners
            for axis in range(3):
                for end in (0, 1):
                    if index[axis] == end * (shape[axis] - 1):
                        self.sides.setdefault((axis, end), []).append(count)

    def _number(self, index, shape):
        return int(1 + index[0] + (shape[0] + 1) * (index[1] + (shape[1] + 1) * index[2]))

    def at(self, axis, place):
        return [number for number, one in self.nodes.items() if one[axis] == place]


BLOCK, ARM = Box((1, 1, 1), (2, 2, 2)), Box((4, 1, 1), (4, 1, 1))
PARTS = ((BLOCK, "block"), (ARM, "arm"), (ARM, "arm2"))


def _mesh(box, name, keep=lambda place: place, nodes=0, elements=0):
    lines = ["*Node"]
    for number, place in box.nodes.items():
        lines.append(f"{number + nodes}, " + ", ".join(repr(float(one)) for one in keep(place)))
    lines.append(f"*Element, Type=C3D8I, elset={name}")
    for number, corners in box.elements.items():
        lines.append(", ".join(str(one) for one in [number + elements, *np.add(corners, nodes)]))
    return "\n".join(lines) + "\n"


def _numbers(numbers):
    return "".join(f"{number},\n" for number in numbers)


def _labels(box, side, offset):
    return "".join(f"{one + offset}, S{FACES[side]}\n" for one in box.sides[side])


def assembly():
    """Returns the deck and its further files."""
    files = {
        "mesh/arm.inp": _mesh(ARM, "All"),
        "mesh/sets.inp": "*Nset, nset=tip\n" + _numbers(ARM.at(0, 4.0)),
    }
    text = f"""*Heading
 Two arms on a block
*PART, name=Block
{_mesh(BLOCK, "All")}*nset, NSET=Foot
{_numbers(BLOCK.at(2, 0.0))}*Surface, type=ELEMENT, name=Right
{_labels(BLOCK, (0, 1), 0)}*Solid Section, elset=ALL, material=Steel
,
*End Part
*Part, name="Long arm"
*Include, input=mesh/arm.inp
*INCLUDE, Input=mesh/sets.inp
*Orientation, name=Grain
1., 0., 0., 0., 1., 0.
3, 0.
*Solid section, Elset=All, Material=WOOD, orientation=GRAIN, controls=EC-1
*End part
*Assembly, name=Whole
*Instance, name=Block-1, part=block
*End Instance
*Instance, name=Arm-1, part="LONG ARM"
1., 0., 0.
*end instance
*Instance, name=Arm-2, part="long arm"
1., 0., 0.
0.5, 0.5, 0., 0.5, 0.5, 1., 90.
*End Instance
*Node
1, 5.5, 0.5, 0.5
*Nset, nset=Point
 1,
*Elset, elset=_Upper_S{FACES[1, 1]}, internal, instance=BLOCK-1
{_numbers(BLOCK.sides[1, 1])}*Surface, type=element, name=Upper
_Upper_S{FACES[1, 1]}, S{FACES[1, 1]}
*Elset, elset=Roots, instance=Arm-1
{_numbers(ARM.sides[0, 0])}*Surface, name=Root1
Roots, S{FACES[0, 0]}
*Elset, elset=Root2, instance=Arm-2
{_numbers(ARM.sides[0, 0])}*Surface, name=Root2
Root2, S{FACES[0, 0]}
*Nset, nset=Tips
Arm-1.tip, "Arm-2".TIP
*Nset, nset=Loaded
Tips,
*Tie, name=First, adjust=yes
Root1, Block-1.Right
*Tie, name=Second
Whole.Root2, Upper
*Surface, type=node, name=Tip
Arm-1.Tip, 1.
*Coupling, constraint name=End, ref node=Point, surface=Tip
*Kinematic
*Element, type=MASS, elset=Weights
1, 1
*Mass, elset=Weights
1.e-9,
*End Assembly
*Section Controls, name=EC-1, hourglass=ENHANCED
1., 1., 1.
{STEEL}{WOOD}*Boundary
Block-1.Foot, ENCASTRE
*Step, name=Load, nlgeom=NO
*Static
*Cload
Arm-2.Tip, 3, -2.
Point, 5, 7.
*Dload
, Grav, 9810., 0., 0., -1.
*Output, field, variable=PRESELECT
*End Step
*Step, name=Modes, perturbation
*Frequency, eigensolver=Lanczos, normalization=mass
6, , ,
*End Step
"""
    return text, files


def flat():
    """Returns the flat deck, with the words that only CalculiX has."""
    places = (
        lambda place: place,
        lambda place: place + [1, 0, 0],
        lambda place: TURN @ (place + [1, 0, 0] - MIDDLE) + MIDDLE,
    )
    offsets = [0, 1000, 3000]
    meshes = [
        _mesh(box, name, keep, offset, offset)
        for (box, name), keep, offset in zip(PARTS, places, offsets)
    ]

    def surface(name, side, box, offset):
        return f"*SURFACE, NAME={name}\n{_labels(box, side, offset)}"

    def nodes(name, numbers, offset):
        return f"*NSET, NSET={name}\n" + _numbers(np.add(numbers, offset))

    return f"""{"".join(meshes)}*NODE
9000, 5.5, 0.5, 0.5
9001, 5.5, 0.5, 0.5
{nodes("FOOT", BLOCK.at(2, 0.0), 0)}{nodes("TIP1", ARM.at(0, 4.0), 1000)}\
{nodes("TIP2", ARM.at(0, 4.0), 3000)}\
{surface("RIGHT", (0, 1), BLOCK, 0)}{surface("UPPER", (1, 1), BLOCK, 0)}\
{surface("ROOT1", (0, 0), ARM, 1000)}{surface("ROOT2", (0, 0), ARM, 3000)}\
{STEEL}{WOOD}*ORIENTATION, NAME=GRAIN1
1., 0., 0., 0., 1., 0.
*ORIENTATION, NAME=GRAIN2
0., 1., 0., -1., 0., 0.
*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL
*SOLID SECTION, ELSET=ARM, MATERIAL=WOOD, ORIENTATION=GRAIN1
*SOLID SECTION, ELSET=ARM2, MATERIAL=WOOD, ORIENTATION=GRAIN2
*TIE, NAME=FIRST
ROOT1, RIGHT
*TIE, NAME=SECOND
ROOT2, UPPER
*RIGID BODY, NSET=TIP1, REF NODE=9000, ROT NODE=9001
*ELEMENT, TYPE=MASS, ELSET=WEIGHT
9000, 9000
*MASS, ELSET=WEIGHT
1.E-9
*BOUNDARY
FOOT, 1, 3
*STEP
*STATIC
*CLOAD
TIP2, 3, -2.
9001, 2, 7.
*DLOAD
BLOCK, GRAV, 9810., 0., 0., -1.
ARM, GRAV, 9810., 0., 0., -1.
ARM2, GRAV, 9810., 0., 0., -1.
*END STEP
*STEP
*FREQUENCY
6
*END STEP
"""
