#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Nodes within reach of the masters of ties and contacts."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_decks import Imported, cube, refused

from squeal.deck.case import proximity
from squeal.deck.case.projection import Surface


def blocks(x, z):
    """Two unit cubes beside each other over the lower one, whose top is UP; DOWN is below them."""
    corners = [(x + a, b, z + c) for c in (0, 1) for b in (0, 1) for a in (0, 1, 2)]
    lines = [f"{11 + n}, {p[0]}, {p[1]}, {p[2]}\n" for n, p in enumerate(corners)]
    cells = "2, 11, 12, 15, 14, 17, 18, 21, 20\n3, 12, 13, 16, 15, 18, 19, 22, 21\n"
    surfaces = "*SURFACE, NAME=UP\n1, S2\n*SURFACE, NAME=DOWN\n2, S1\n3, S1\n"
    cells = "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n" + cells
    return "*NODE\n" + "".join(lines) + cells + surfaces


def tied(x, z, parameters=""):
    return Imported(cube(blocks(x, z) + f"*TIE, NAME=T{parameters}\nDOWN, UP\n"))


class Counts(unittest.TestCase):
    """The lower cube ends at x = 1. Half the size of a slave face is half its diagonal, 0.7071. The
    counts are those of the program."""

    def test_ties_of_faces(self):
        for x, z, parameters, row in (
            (0.0, 1.0, "", "4 | 2"),
            (0.5, 1.0, "", "4 | 2"),
            (-0.5, 1.0, "", "6 | 0"),  # both faces are half covered
            (1.0, 1.0, "", "0 | 6"),  # an edge has no area
            (0.0, 1.7, "", "4 | 2"),
            (0.0, 1.6, ", POSITION TOLERANCE=0.5", "0 | 6"),
            (-0.5, 1.4, ", POSITION TOLERANCE=0.5", "6 | 0"),
        ):
            one = tied(x, z, parameters)
            self.assertIn("## Ties\n\n| tie | slave | tied nodes | free nodes |\n", one.account)
            self.assertIn(f"| T | faces | {row} |\n", one.account)
            count, free = row.split(" | ")
            self.assertIn(f"{count} nodes tied, {free} free", one.remarks("TIE"))
            missed = [text for text in one.journal.choices if "within reach" in text]
            self.assertEqual(len(missed), count == "0", missed)

    def test_faces_that_do_not_face_each_other(self):
        """A side of the upper cube, its top with the lower one below, and all its free faces."""
        for z, faces, row in (
            (1.0, "2, S3", "0 | 4"),
            (-0.2, "2, S2", "0 | 4"),
            (1.0, "2,", "4 | 4"),
        ):
            text = blocks(0.0, z).replace("2, S1\n3, S1\n", faces + "\n")
            one = Imported(cube(text + "*TIE, NAME=T\nDOWN, UP\n"))
            self.assertIn(f"| T | faces | {row} |\n", one.account)

    def test_collapsed_faces(self):
        """With one of two triangles, and with none."""
        tie = "*SURFACE, NAME=UP\n1, S2\n*NSET, NSET=N\n41, 42, 43\n"
        tie += "*SURFACE, NAME=N, TYPE=NODE\nN\n*TIE, NAME=T, POSITION TOLERANCE=0.4\nN, UP\n"
        brick = (
            "*NODE\n41, 0.5, 0.5, 1.05\n42, 1.3, 0.6, 1.05\n43, 1.3, 1.3, 1.3\n44, .6, .6, 1.9\n"
        )
        brick += "*ELEMENT, TYPE=C3D4, ELSET=CUBE\n2, 41, 42, 43, 44\n"
        one = Imported(cube(brick + tie).replace("\n8, 0., 1., 1.", "\n8, 1., 1., 1."))
        self.assertIn("| T | nodes | 1 | 2 |\n", one.account)
        text = cube(blocks(0.0, 1.0) + "*TIE, NAME=T\nDOWN, UP\n")
        text = text.replace("\n8, 0., 1., 1.", "\n8, 1., 1., 1.").replace("\n5, 0.,", "\n5, 1.,")
        self.assertIn("| T | faces | 0 | 6 |\n", Imported(text).account)

    def test_a_distance_of_zero(self):
        """The program would take it as its default."""
        for value in ("0.", "-1."):
            text = cube(blocks(0.0, 1.0) + f"*TIE, NAME=T, POSITION TOLERANCE={value}\nDOWN, UP\n")
            self.assertIn("faces need a positive distance", refused(text)[0])

    def test_contacts(self):
        pair = "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nDOWN, UP\n"
        pair += "*SURFACE INTERACTION, NAME=I\n"
        for x, z, row in ((-0.5, 1.0, "6 | 0"), (0.5, 1.7, "4 | 2"), (0.0, 1.8, "0 | 6")):
            one = Imported(cube(blocks(x, z) + pair))
            (name,) = one.options["contact"]
            self.assertIn("## Contacts\n\n| interface | nodes in reach | others |\n", one.account)
            self.assertIn(f"| {name} | {row} |\n", one.account)
            missed = [text for text in one.journal.choices if "within reach" in text]
            self.assertEqual(len(missed), row == "0 | 6", missed)


class Assignment(unittest.TestCase):
    """Against each triangle in turn, on a wavy surface of faces with 3, 4, 6 and 8 nodes."""

    def setUp(self):
        self.generator = np.random.default_rng(5)
        number, tables = 0, []
        for size in (4, 3, 8, 6):
            faces = np.array([self.face(size) for _ in range(15)])
            tables.append((np.arange(number, number + 15), faces))
            number += 15
        self.surface = Surface(tables)

    def face(self, size):
        corners = [(0, 0), (1, 0), (0, 1)] if size in (3, 6) else [(0, 0), (1, 0), (1, 1), (0, 1)]
        flat = list(corners)
        if size > 4:
            ends = zip(corners, corners[1:] + corners[:1])
            flat += [tuple(np.add(a, b) / 2) for a, b in ends]
        scale = self.generator.uniform(0.2, 0.8)  # faces of different sizes share boxes
        plane = np.array(flat) * scale + self.generator.uniform(0, 2, 2)
        return np.column_stack([plane, 0.1 * np.sin(3 * plane[:, 0]) * np.cos(2 * plane[:, 1])])

    def nearest(self, point, beside, reach):
        best, margin = (np.inf, -1, np.inf), np.hypot(beside, reach)
        for owner, corners in zip(self.surface.owners, self.surface.corners):
            low, high = corners.min(axis=0) - margin, corners.max(axis=0) + margin
            if np.any(point < low) or np.any(point > high):
                continue
            normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
            normal /= np.linalg.norm(normal)
            height = abs(np.dot(point - corners[0], normal))
            outwards = []
            for a, b in zip(corners, np.roll(corners, -1, axis=0)):
                out = np.cross(b - a, normal)
                outwards.append(np.dot(point - a, out / np.linalg.norm(out)))
            if max(outwards) <= beside and height <= reach:
                inside = max(outwards) <= 1e-9 * self.surface.size
                best = min(best, (height + (0 if inside else 1e3), owner, height))
        return best[1:]

    def test_against_each_triangle(self):
        points = self.generator.uniform((-0.2, -0.2, -0.3), (2.4, 2.4, 0.3), (80, 3))
        for beside, reach in ((0.0, 0.1), (0.02, 0.4), (0.3, 0.05)):
            owners, distances = self.surface.assign(points, beside, reach)
            wanted = [self.nearest(point, beside, reach) for point in points]
            self.assertEqual(owners.tolist(), [one[0] for one in wanted])
            found = owners >= 0
            self.assertTrue(10 < np.sum(found) < 70, np.sum(found))
            exact = np.array([one[1] for one in wanted])
            self.assertLess(np.abs(distances[found] - exact[found]).max(), 1e-14)

    def test_one_large_face_among_small_ones(self):
        corners = np.array([(0, 0, 0), (60, 0, 60), (60, 60, 60), (0, 60, 0)], float)
        small = np.array([(0, 0, 0), (0.1, 0, 0), (0.1, 0.1, 0), (0, 0.1, 0)])
        places = np.concatenate(
            [corners[None], small + self.generator.uniform(0, 60, (5000, 1, 3))]
        )
        surface = Surface([(np.arange(5001), places)])
        points = places[1:].mean(axis=1)
        owners, _ = surface.assign(points, 1e-6, 1e-6)
        self.assertGreater(np.sum(owners == np.arange(1, 5001)), 4990)

    def test_in_parts(self):
        points = self.generator.uniform((0, 0, -0.2), (2, 2, 0.2), (300, 3))
        whole = self.surface.assign(points, 0.02, 0.2)
        most, proximity.MOST = proximity.MOST, 7
        try:
            parts = self.surface.assign(points, 0.02, 0.2)
        finally:
            proximity.MOST = most
        self.assertEqual(whole[0].tolist(), parts[0].tolist())
        self.assertEqual(whole[1].tolist(), parts[1].tolist())


if __name__ == "__main__":
    unittest.main()
