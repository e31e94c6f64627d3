# SPDX-License-Identifier: BSD-2-Clause
"""The brake with a floating caliper as bulk data of MSC Nastran, SOL 400."""
import numpy as np
from write_bdf import free, large, small

GLUE, CLOSED, GRIP = 1, 2, 3  # numbers of parameters of contact
STICKING = 1.0e3  # a coefficient that no node exceeds
CONTROL = """ID CALIPER, BRAKE $ of the tests
SOL 400
TIME 600
CEND
TITLE = Floating caliper, coarse,
ECHO = NONE
SPC = 10
BCONTACT = 5
SUBCASE 1
  STEP 1
    ANALYSIS = NLSTATIC
    NLPARM = 1
    LOAD = 20
    DISPLACEMENT(SORT1,REAL,
                 PLOT) = ALL
  STEP 2
    ANALYSIS = MCEIG
    METHOD = 30
    CMETHOD = 31
    BSQUEAL = 7
BEGIN BULK
"""


def stiffness(options):
    """Returns the matrix of MAT9 of a material that is isotropic across z."""
    plane, across, nu, nu_across, shear = map(float, options["transverse"].split(","))
    compliance = np.diag([1 / plane, 1 / plane, 1 / across, 2 * (1 + nu) / plane, 1 / shear])
    compliance = np.pad(compliance, (0, 1))
    compliance[5, 5] = 1 / shear
    compliance[0, 1] = compliance[1, 0] = -nu / plane
    compliance[:2, 2] = compliance[2, :2] = -nu_across / plane
    return np.linalg.inv(compliance)


class Caliper:
    """`case`: the options of the brake; `mesh`: its mesh of tetrahedra (`places`, `bodies`,
    `faces`); `slaves`: interface -> "pad" or "disc", the side that a deck has first."""

    def __init__(self, case, mesh, slaves):
        self.case, self.mesh, self.slaves = case, mesh, slaves
        self.bodies = {name: number for number, name in enumerate(sorted(mesh.bodies), 1)}
        self.regions = {name: 100 + number for number, name in enumerate(sorted(mesh.faces))}
        self.owners, self.cells = {}, []
        for name, cells in sorted(mesh.bodies.items()):
            for cell in cells:
                self.cells.append((self.bodies[name], cell))
                for corner in range(4):
                    face = frozenset(cell[:corner] + cell[corner + 1 : 4])
                    self.owners.setdefault(face, []).append((len(self.cells), cell[corner]))

    def deck(self, friction):
        lines = [large("GRID", at, None, *map(float, one)) for at, one in self.mesh.places.items()]
        order = (*range(8), 9, 8)
        for number, (body, cell) in enumerate(self.cells, 1):
            nodes = [cell[at] for at in order[: len(cell)]]
            lines.append((small, free)[number % 2]("CTETRA", number, body, *nodes))
        text = CONTROL + "".join(lines) + self._materials() + self._state()
        return text + self._contacts(friction) + "ENDDATA\n"

    def _materials(self):
        text = ""
        for name, number in self.bodies.items():
            options = self.case["material"][name]
            density = float(options["density"])
            text += small("PSOLID", number, number)
            if "transverse" in options:
                matrix = stiffness(options)
                values = [float(matrix[i, j]) for i in range(6) for j in range(i, 6)]
                text += large("MAT9", number, *values, density)
            else:
                text += large(
                    "MAT1",
                    number,
                    float(options["young"]),
                    None,
                    float(options["poisson"]),
                    density,
                )
        return text

    def _state(self):
        text = small("EIGRL", 30, None, None, 30) + small("NLPARM", 1, 1)
        for number, name in enumerate(self.case["constraint"], 1):
            nodes = sorted({node for face in self.mesh.faces[name] for node in face})
            text += small("SPC1", number, 123456, *nodes)
        text += small("SPCADD", 10, *range(1, len(self.case["constraint"]) + 1))
        parts = []
        for number, (name, load) in enumerate(self.case["load"].items(), 21):
            parts += [float(load["pressure"]), number]
            for face in self.mesh.faces[name]:
                element, opposite = self._element(face)
                end = (face[0], opposite)
                text += small("PLOAD4", number, element, 1.0, None, None, None, *end)
        return text + small("LOAD", 20, 1.0, *parts)

    def _element(self, face):
        (found,) = self.owners[frozenset(face[:3])]
        return found

    def _contacts(self, friction):
        text = small("BCPARA", 0, "FTYPE", 6) + small("BCONPRG", GLUE, None, "IGLUE", 1)
        text += small("BCONPRG", CLOSED, None, "ICOORD", 1)
        text += small("BCONPRP", GRIP, None, "FRIC", STICKING)
        text += small("MOTION", 61, 5.0, *[None] * 6, *self._axis())
        text += small("BRKPROP", 71, None, "AVSTIF", 1.0e16, "FRICT", friction)
        brakes, pairs, used = [], [], set()
        for name, one in self.case["contact"].items():
            sides = sorted(("disc", "pad"), key=lambda side: side != self.slaves[name])
            slave, master = (self.regions[one[side]] for side in sides)
            geometry = CLOSED if "gap" in one else None
            pairs.append((geometry, GRIP if one["role"] == "sticking" else None, slave, master))
            if one["role"] == "sliding":
                brakes += [name[:8].upper(), slave, master, 61, None, 71, None, None]
            used |= {one["pad"], one["disc"]}
        for one in self.case["tie"].values():
            pairs.append((GLUE, None, self.regions[one["slave"]], self.regions[one["master"]]))
            used |= {one["slave"], one["master"]}
        text += small("BRKSYS", 7, None, 0, "YES", None, None, None, None, *brakes)
        for number, pair in enumerate(pairs, 1):
            text += small("BCONECT", number, *pair)
        text += small("BCTABL1", 5, 1, "THRU", len(pairs))
        return text + "".join(self._region(name) for name in sorted(used))

    def _axis(self):
        (motion,) = self.case["motion"].values()
        words = [*motion["axis"].split(","), *motion["origin"].split(",")]
        return ["ROTAT", *map(float, words)]

    def _region(self, name):
        words = [self.regions[name], None, "3D", "GRID", *[None] * 4]
        for face in self.mesh.faces[name]:
            words += [self._element(face)[0], *face[:3]]
        return small("BCSURF", *words)
