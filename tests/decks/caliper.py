# SPDX-License-Identifier: BSD-2-Clause
"""The brake with a floating caliper as an assembly of Abaqus: each body is a part that is moved and
turned into its place, in a file of its own, with names in mixed case and sets of sets."""
import ctypes
import ctypes.util

import numpy as np

TETRAHEDRON = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
# Names of interactions by the role of an interface.
INTERACTIONS = {"sliding": "Rubbing", "sticking": "Grip", "frictionless": "Guide"}


def mesh_geometry(geometry, path, **parameters):
    """Meshes a geometry of gmsh with these parameters and writes it, in the format 2.2."""
    library = ctypes.CDLL(ctypes.util.find_library("gmsh"))
    error = ctypes.c_int(0)

    def call(name, *words):
        getattr(library, name)(*words, ctypes.byref(error))
        if error.value:
            raise RuntimeError(f"{name}: error {error.value}")

    call("gmshInitialize", 0, None, 1)
    call("gmshOptionSetNumber", b"General.Terminal", ctypes.c_double(0))
    call("gmshOptionSetNumber", b"Mesh.MshFileVersion", ctypes.c_double(2.2))
    for name, value in parameters.items():
        array = (ctypes.c_double * 1)(value)
        call("gmshOnelabSetNumber", name.encode(), array, ctypes.c_size_t(1))
    call("gmshOpen", str(geometry).encode())
    call("gmshModelMeshGenerate", 3)
    call("gmshWrite", str(path).encode())
    call("gmshFinalize")


class Mesh:
    """`places` by node number; `bodies`: name -> tetrahedra; `faces`: name -> triangles."""

    def __init__(self, path):
        sections = {}
        lines = iter(path.read_text().splitlines())
        for line in lines:
            if line.startswith("$") and not line.startswith("$End"):
                rows = []
                for row in lines:
                    if row.startswith("$End"):
                        break
                    rows.append(row)
                sections[line[1:]] = rows
        names = {}
        for row in sections["PhysicalNames"][1:]:
            dimension, number, name = row.split(" ", 2)
            names[int(dimension), int(number)] = name.strip('"')
        table = np.array([row.split() for row in sections["Nodes"][1:]], float)
        self.places = dict(zip(table[:, 0].astype(int).tolist(), table[:, 1:]))
        self.bodies, self.faces = {}, {}
        for row in sections["Elements"][1:]:
            _, kind, count, group, *rest = map(int, row.split())
            nodes = rest[count - 1 :]
            if kind in (4, 11):
                self.bodies.setdefault(names[3, group], []).append(nodes)
            elif kind in (2, 9):
                self.faces.setdefault(names[2, group], []).append(nodes)


def _turn(axis, degrees):
    """The matrix of a rotation, by its exponential series."""
    x, y, z = np.radians(degrees) * np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    total, term = np.eye(3), np.eye(3)
    for number in range(1, 60):
        term = term @ cross / number
        total += term
    return total


class Part:
    """A body in axes of its own: p = R (x + t - a) + a in the assembly."""

    def __init__(self, number, name, cells, places):
        self.name, self.instance = name.title(), f"{name}-1"
        self.number = number
        self.cells = cells
        used = sorted({node for cell in cells for node in cell})
        self.nodes = {node: at for at, node in enumerate(used, 1)}
        self.shift = np.array([0.01 * number, -0.02, 0.003 * number])
        self.a, axis = np.array([0.05, 0.01 * number, 0]), np.array([1.0, 0.5 * number, 2])
        self.b, self.angle = self.a + axis, 37.0 * number
        self.matrix = _turn(axis, self.angle)
        there = np.array([places[node] for node in used])
        self.places = (there - self.a) @ self.matrix + self.a - self.shift
        self.labels = {
            frozenset(cell[corner] for corner in face): (element, label)
            for element, cell in enumerate(cells, 1)
            for label, face in enumerate(TETRAHEDRON, 1)
        }

    def position(self):
        rows = [self.shift, [*self.a, *self.b, self.angle]]
        return "".join(", ".join(map(repr, map(float, row))) + "\n" for row in rows)

    def mesh(self):
        order = (*range(8), 9, 8) if len(self.cells[0]) == 10 else range(4)
        kind = "C3D10" if len(self.cells[0]) == 10 else "c3d4"
        lines = ["*Node, nset=All"]
        for number, place in enumerate(self.places, 1):
            lines.append(f"{number}, {', '.join(repr(float(one)) for one in place)}")
        lines.append(f"*Element, type={kind}, elset=Cells")
        for number, cell in enumerate(self.cells, 1):
            numbers = [number, *(self.nodes[cell[at]] for at in order)]
            lines.append(", ".join(map(str, numbers)))
        return "\n".join(lines) + "\n"

    def surface(self, name, triangles):
        """Returns the cards of a surface by an element set for each label of a face."""
        found = {}
        for face in triangles:
            element, label = self.labels[frozenset(face[:3])]
            found.setdefault(label, []).append(element)
        text, rows = "", ""
        for label, elements in sorted(found.items()):
            text += f"*Elset, elset=_{name}_s{label}, internal\n"
            text += "".join(f"{element},\n" for element in elements)
            rows += f"_{name.upper()}_S{label}, S{label}\n"
        return f"{text}*Surface, type=ELEMENT, name={name}\n{rows}"

    def node_set(self, name, triangles):
        numbers = sorted({self.nodes[node] for face in triangles for node in face})
        half = len(numbers) // 2
        text = ""
        for part, some in (("a", numbers[:half]), ("b", numbers[half:])):
            text += f"*Nset, nset={name}-{part}\n" + "".join(f"{one},\n" for one in some)
        return text + f"*NSET, NSET={name}\n{name}-A, {name}-B\n"


def _material(name, options):
    lines = [f"*Material, name={name}"]
    if "transverse" in options:
        plane, across, nu, nu_across, shear = map(float, options["transverse"].split(","))
        constants = [plane, plane, across, nu, nu_across, nu_across, plane / (2 + 2 * nu), shear]
        lines += ["*Elastic, type=ENGINEERING CONSTANTS", ", ".join(map(repr, constants))]
        lines += [repr(shear)]
    else:
        lines += ["*Elastic", f"{options['young']}, {options['poisson']}"]
    return "\n".join([*lines, "*Density", f"{options['density']},"]) + "\n"


class Caliper:
    """`case`: the options of the brake; `mesh`: its mesh; `slaves`: interface -> "pad" or "disc",
    the side that a deck has first."""

    def __init__(self, case, mesh, slaves):
        self.case, self.slaves = case, slaves
        self.parts = {
            name: Part(number, name, cells, mesh.places)
            for number, (name, cells) in enumerate(sorted(mesh.bodies.items()))
        }
        self.owners, self.mesh = {}, mesh
        for name, triangles in mesh.faces.items():
            key = frozenset(triangles[0][:3])
            self.owners[name] = next(p for p in self.parts.values() if key in p.labels)

    def deck(self, friction, divided=()):
        """Returns the deck and its further files. `friction`: from 0 in the first steps; `divided`:
        bodies with two sections, of the lower and the upper half of the numbers of their cells."""
        files, parts, instances, materials = {}, "", "", ""
        for name, part in self.parts.items():
            text = part.mesh()
            for surface, owner in self.owners.items():
                if owner is part:
                    text += part.surface(surface, self.mesh.faces[surface])
            for group in self.case["constraint"]:
                if self.owners[group] is part:
                    text += part.node_set(f"{group}_nodes", self.mesh.faces[group])
            files[f"Parts/{name}.inp"] = text
            parts += f"*Part, name={part.name}\n*Include, input=Parts/{name}.inp\n"
            options = self.case["material"][name]
            more = ""
            if "transverse" in options:
                a, b, _ = part.matrix  # rows: the axes of the assembly, in those of the part
                parts += "*Orientation, name=Plane\n"
                parts += ", ".join(repr(float(one)) for one in (*a, *b)) + "\n3, 0.\n"
                more = ", ORIENTATION=plane"
            count = len(part.cells)
            halves = {"Lower": (1, count // 2), "Upper": (count // 2 + 1, count)}
            for half, (first, last) in halves.items() if name in divided else ():
                parts += f"*elset, elset={half}, generate\n{first}, {last}\n"
                parts += f"*solid section, elset={half}, material={name}{more}\n,\n"
            if name not in divided:
                parts += f"*solid section, elset=CELLS, material={name}{more}\n,\n"
            parts += "*End Part\n"
            instances += f"*Instance, name={part.instance}, part={part.name.upper()}\n"
            instances += f"{part.position()}*End Instance\n"
            materials += _material(name, options)
        text = f"*Heading\nFloating caliper\n{parts}*Assembly, name=Brake\n{instances}"
        text += f"{self._constraints()}*End Assembly\n{materials}{self._contacts()}"
        return text + self._steps(friction), files

    def _name(self, surface):
        return f"{self.owners[surface].instance}.{surface}"

    def _constraints(self):
        held = ", ".join(f"{self._name(group)}_nodes" for group in self.case["constraint"])
        text = f"*Nset, nset=Held\n{held}\n"
        for name, tie in self.case["tie"].items():
            text += f"*Tie, name={name}\n{self._name(tie['slave'])}, {self._name(tie['master'])}\n"
        return text

    def _contacts(self):
        text = ""
        for role, name in INTERACTIONS.items():
            law = {"sliding": "*Friction\n0.,\n", "sticking": "*Friction, rough\n"}.get(role, "")
            text += f"*Surface Interaction, name={name}\n1.,\n{law}"
            text += "*Surface Behavior, pressure-overclosure=HARD\n"
        for name, one in self.case["contact"].items():
            adjust = ", adjust=0.003" if "gap" in one else ""
            text += (
                f"*Contact Pair, interaction={INTERACTIONS[one['role']]}, small sliding{adjust}\n"
            )
            slave = self.slaves[name]
            master = {"pad": "disc", "disc": "pad"}[slave]
            text += f"{self._name(one[slave])}, {self._name(one[master])}\n"
        return text + "*Boundary\nHeld, ENCASTRE\n"

    def _steps(self, friction):
        pressures = "".join(
            f"{self._name(group)}, P, {load['pressure']}\n"
            for group, load in self.case["load"].items()
        )
        (turning,) = self.case["motion"].values()
        (body,) = self.case["motion"]
        axis = ", ".join([turning["origin"], turning["axis"]])
        return f"""*Step, name=Pressure, nlgeom=NO
*Static
*Dsload
{pressures}*End Step
*Step, name=Rotation
*Static
*Motion, rotation
{self.parts[body].instance}.ALL, {turning["speed"]}, {axis}
*End Step
*Step, name=Friction, unsymm=YES
*Static
*Change Friction, interaction=RUBBING
*Friction
{friction},
*End Step
*Step, name=Real, perturbation
*Frequency
30,
*End Step
*Step, name=Complex, perturbation, unsymm=YES
*Complex Frequency
30,
*End Step
"""
