#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Cards of Abaqus through import and program, against closed forms: test_abaqus.py PROGRAM."""
import sys
import unittest
from pathlib import Path
from unittest import mock

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / one) for one in ("python", "tests/support/deck", "tests/decks")]
sys.dont_write_bytecode = True
import numpy as np
from assembled import FACES, Box
from solved import Solved

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
LENGTH, WIDTH, CELLS = 6.0, 1.0, 6
YOUNG, DENSITY = 1000.0, 2.0
BAR = Box((LENGTH, WIDTH, WIDTH), (CELLS, 2, 2))
HALF = [number for number, nodes in BAR.elements.items() if BAR.nodes[nodes[0]][0] < LENGTH / 2]


def material(name, young, more=""):
    return f"*MATERIAL, NAME={name}\n*ELASTIC\n{young}, 0.\n*DENSITY\n{DENSITY},\n{more}"


def rows(numbers):
    return "".join(f"{number},\n" for number in numbers)


def bar(cards, steps, sections="*SOLID SECTION, ELSET=ALL, MATERIAL=M\n,\n", free=False):
    """Returns the deck of a bar along x as an instance, built in at x = 0, with Poisson's ratio 0;
    `cards`: of the assembly."""
    nodes = "".join(f"{one}, {x}, {y}, {z}\n" for one, (x, y, z) in BAR.nodes.items())
    cells = "".join(f"{one}, {', '.join(map(str, all))}\n" for one, all in BAR.elements.items())
    held = "" if free else "*BOUNDARY\nBar-1.Root, ENCASTRE\n"
    return f"""*PART, NAME=Bar
*NODE
{nodes}*ELEMENT, TYPE=C3D8I, ELSET=All
{cells}*NSET, NSET=Root
{rows(BAR.at(0, 0.0))}*NSET, NSET=Tip
{rows(BAR.at(0, LENGTH))}*ELSET, ELSET=Half
{rows(HALF)}*ELSET, ELSET=Rest
{rows(set(BAR.elements) - set(HALF))}*ELSET, ELSET=End
{rows(BAR.sides[0, 1])}*SURFACE, NAME=End
End, S{FACES[0, 1]}
*ELSET, ELSET=Middle
{rows(one for one in HALF if BAR.nodes[BAR.elements[one][1]][0] == LENGTH / 2)}*SURFACE, NAME=Cut
Middle, S{FACES[0, 1]}
{sections}*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=Bar-1, PART=Bar
*END INSTANCE
{cards}*END ASSEMBLY
{material("M", YOUNG)}{held}{steps}"""


def static(loads):
    return f"*STEP\n*STATIC\n{loads}*END STEP\n"


def frequencies(count):
    return f"*STEP, PERTURBATION\n*FREQUENCY\n{count}\n*END STEP\n"


class ClosedForms(unittest.TestCase):
    def near(self, found, wanted, tolerance=1e-9):
        size = np.max(np.abs(wanted))
        self.assertLessEqual(np.max(np.abs(np.subtract(found, wanted))), tolerance * size)

    def test_sections_of_one_body(self):
        """Two halves in series: F (l / E + l / 3E) / A."""
        sections = (
            "*SOLID SECTION, ELSET=HALF, MATERIAL=M\n*SOLID SECTION, ELSET=REST, MATERIAL=N\n"
        )
        text = bar("", static("*DSLOAD\nBar-1.End, P, -5.\n"), sections)
        one = Solved(PROGRAM, text + material("N", 3 * YOUNG))
        self.assertIn('sections: "Bar-1.Half,Bar-1.Rest"', one.case)
        stretch = 5 * LENGTH / 2 * (1 + 1 / 3) / YOUNG
        self.near(one.at([[LENGTH, 0, 0], [LENGTH, 1, 1]]), [[stretch, 0, 0]] * 2)

    def test_forces_per_volume(self):
        """b per volume along the axis: u = b L² / 2E at the end."""
        one = Solved(PROGRAM, bar("", static("*DLOAD\n, BX, 0.7\n")))
        self.near(one.at([[LENGTH, 0, 0]])[0, 0], 0.7 * LENGTH**2 / (2 * YOUNG))
        spin = "*DLOAD\nBar-1.All, CENT, 0.3, 0., 0., 0., 0., 0., 1.\n"
        one = Solved(PROGRAM, bar("", static(spin)))
        # The mean over the section: ρω² ∫ x² dx / E.
        mean = one.at([BAR.nodes[number] for number in BAR.at(0, LENGTH)])[:, 0].mean()
        self.near(mean, 0.3 * LENGTH**3 / (3 * YOUNG), 0.01)

    def test_a_distributing_coupling_follows_the_mean(self):
        cards = f"*NODE\n1, {LENGTH + 2}, 0.5, 0.5\n*NSET, NSET=R\n1\n"
        cards += "*COUPLING, CONSTRAINT NAME=C, REF NODE=R, SURFACE=Bar-1.End\n*DISTRIBUTING\n"
        one = Solved(PROGRAM, bar(cards, static("*CLOAD\nR, 1, 8.\n")))
        tip = one.at([BAR.nodes[number] for number in BAR.at(0, LENGTH)])
        self.near(one.references()[0, 0], tip.mean(axis=0))
        # The forces are shares of the area, so the end moves as in plain tension.
        self.near(tip[:, 0], np.full(len(tip), 8 * LENGTH / YOUNG))
        # A force aside bends the bar like that force and its moment at the end.
        one = Solved(PROGRAM, bar(cards, static("*CLOAD\nR, 3, 0.01\n")))
        bending = YOUNG / 12
        end = 0.01 * (LENGTH**3 / 3 + 2 * LENGTH**2 / 2) / bending
        shear = 0.01 * LENGTH / (YOUNG / 2 * 5 / 6)
        tip = one.at([BAR.nodes[number] for number in BAR.at(0, LENGTH)])[:, 2].mean()
        self.near(tip, end + shear, 0.01)

    def test_a_distributing_coupling_of_distorted_faces(self):
        """Its forces are those of an even traction, and the reference node has the mean over the
        area, in which the nodes of a trapezium have different parts."""
        (centre,) = [one for one in BAR.at(0, LENGTH) if BAR.nodes[one][1:].tolist() == [0.5, 0.5]]
        cards = f"*NODE\n1, {LENGTH + 2}, 0.5, 0.5\n*NSET, NSET=R\n1\n"
        cards += "*COUPLING, CONSTRAINT NAME=C, REF NODE=R, SURFACE=Bar-1.End\n*DISTRIBUTING\n"
        with mock.patch.dict(BAR.nodes, {centre: np.array([LENGTH, 0.7, 0.4])}):
            one = Solved(PROGRAM, bar(cards, static("*CLOAD\nR, 1, 8.\n")))
            tip = one.at([BAR.nodes[number] for number in BAR.at(0, LENGTH)])
        self.near(tip[:, 0], np.full(len(tip), 8 * LENGTH / YOUNG))
        self.near(one.references()[0, 0], [8 * LENGTH / YOUNG, 0, 0])

    def test_a_kinematic_coupling_keeps_the_end_plane(self):
        """A moment about y on a rigid end: the angle M L / E I."""
        card = "*KINEMATIC COUPLING, REF NODE=R\nBar-1.Tip,\n"
        surface = "*COUPLING, CONSTRAINT NAME=C, REF NODE=R, SURFACE=Bar-1.End\n*KINEMATIC\n1, 6\n"
        body = "*RIGID BODY, REF NODE=R, TIE NSET=Bar-1.Tip\n"
        beams = "*MPC\nBEAM, Bar-1.Tip, R\n"
        for one in (card, surface, body, beams):
            cards = f"*NODE\n1, {LENGTH + 2}, 0., 0.5\n*NSET, NSET=R\n1\n" + one
            solved = Solved(PROGRAM, bar(cards, static("*CLOAD\nR, 5, 0.1\n")))
            angle = 0.1 * LENGTH / (YOUNG / 12)
            displacement, rotation = solved.references()[0]
            self.near(rotation, [0, angle, 0], 1e-7)
            # Below the axis the arm of the reference node adds its own turn.
            self.near(displacement[2], -angle * (LENGTH / 2 + 2), 1e-7)

    def test_springs_between_components(self):
        """Masses 2 and 3 with a spring from x of one to y of the other, which has one to the
        ground."""
        cards = "*NODE\n1, 9., 0., 0.\n2, 9., 4., 0.\n"
        for kind, number, nodes, data in (
            ("SPRING2", 1, "1, 2", "*SPRING, ELSET=E{}\n1, 2\n50.\n"),
            ("SPRING1", 2, "2", "*SPRING, ELSET=E{}\n2\n70.\n"),
            ("MASS", 3, "1", "*MASS, ELSET=E{}\n2.\n"),
            ("MASS", 4, "2", "*MASS, ELSET=E{}\n3.\n"),
        ):
            cards += f"*ELEMENT, TYPE={kind}, ELSET=E{number}\n{number}, {nodes}\n"
            cards += data.format(number)
        held = "*BOUNDARY\n1, 2, 6\n2, 1\n2, 3, 6\n"
        one = Solved(PROGRAM, bar(cards, held + frequencies(14)))
        matrix = np.array([[50 / 2, -50 / 2], [-50 / 3, 120 / 3]])
        wanted = np.sqrt(np.sort(np.linalg.eigvals(matrix).real)) / (2 * np.pi)
        found = [one.frequencies[np.argmin(np.abs(one.frequencies - each))] for each in wanted]
        self.near(found, wanted, 1e-7)

    def test_a_lever_with_a_mass_and_an_inertia(self):
        """A BEAM from the hinge 2 to the mass 1 at the distance 3: k / (m l² + J)."""
        cards = "*NODE\n1, 9., 3., 0.\n2, 9., 0., 0.\n*MPC\nBEAM, 1, 2\n"
        cards += "*ELEMENT, TYPE=MASS, ELSET=E1\n1, 1\n*MASS, ELSET=E1\n0.4\n"
        cards += "*ELEMENT, TYPE=MASS, ELSET=E2\n2, 2\n*MASS, ELSET=E2\n0.1\n"
        cards += "*ELEMENT, TYPE=ROTARYI, ELSET=E3\n3, 2\n*ROTARY INERTIA, ELSET=E3\n1., 1., 0.5\n"
        cards += "*ELEMENT, TYPE=SPRING1, ELSET=E4\n4, 2\n*SPRING, ELSET=E4\n6\n9.\n"
        one = Solved(PROGRAM, bar(cards, "*BOUNDARY\n2, 1, 5\n" + frequencies(3)))
        wanted = np.sqrt(9 / (0.4 * 3**2 + 0.5)) / (2 * np.pi)
        self.near(np.min(np.abs(one.frequencies - wanted)) + wanted, wanted, 1e-7)

    def test_pins_and_links(self):
        """PIN: the end hangs on a spring. LINK: only its direction is transmitted."""
        spring = "*NODE\n1, 9., {y}, 0.\n*ELEMENT, TYPE=SPRING1, ELSET=S\n1, 1\n"
        spring += "*SPRING, ELSET=S\n1\n{k}\n"
        corner = BAR.at(0, LENGTH)[0]
        load = static("*DSLOAD\nBar-1.End, P, -5.\n")
        stiff = spring.format(y=0.0, k=1e9)
        pin = stiff + f"*MPC\nPIN, 1, Bar-1.{corner}\n"
        one = Solved(PROGRAM, bar(pin, "*BOUNDARY\n1, 4, 6\n" + load))
        # The corner is held along x.
        self.assertLess(abs(one.at([BAR.nodes[corner]])[0, 0]), 1e-8)
        link = spring.format(y=-4.0, k=1e9) + f"*MPC\nLINK, Bar-1.{corner}, 1\n"
        one = Solved(PROGRAM, bar(link, "*BOUNDARY\n1, 2, 6\n" + load))
        # The line of the link is (6, 0, 0) - (9, -4, 0); node 1 does not move.
        self.assertLess(abs(one.at([BAR.nodes[corner]])[0] @ [3, -4, 0]), 1e-7)
        self.assertGreater(abs(one.at([BAR.nodes[corner]])[0, 0]), 1e-3)

    def test_the_tension_of_a_bolt(self):
        """A bar between walls, drawn together at its middle by the force F: the left half grows by
        F l / E A."""
        cards = "*NODE\n1, 0., 0., 0.\n*PRE-TENSION SECTION, SURFACE=Bar-1.Cut, NODE=1\n"
        steps = "*BOUNDARY\nBar-1.Tip, PINNED\n" + static("*CLOAD\n1, 1, 4.\n")
        steps += static("*BOUNDARY, FIXED\n1, 1\n*DSLOAD\nBar-1.End, P, 0.\n")
        one = Solved(PROGRAM, bar(cards, steps))
        place = [LENGTH / 3, 0, 0]
        self.near(one.at([place])[0], [4 * LENGTH / 3 / YOUNG, 0, 0], 1e-8)


if __name__ == "__main__":
    unittest.main()
