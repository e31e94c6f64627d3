#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Matrices of other programs: each format is read back bit for bit."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/matrices")]
sys.dont_write_bytecode = True
import matrix_files as files
from imported import Imported

from squeal.matrices import text as reader

SIZE = 12


def random_matrix(seed, symmetric=True, digits=None):
    """Returns a sparse matrix without empty rows, of numbers of very different sizes, or of those
    with few digits."""
    rng = np.random.default_rng(seed)
    matrix = rng.standard_normal((SIZE, SIZE)) * 10.0 ** rng.integers(-30, 30, (SIZE, SIZE))
    if digits:
        matrix = rng.integers(-(10**digits) + 1, 10**digits, (SIZE, SIZE)) * 0.5**2
        matrix = np.round(matrix, 2) if digits > 3 else np.rint(matrix)
    matrix[rng.random((SIZE, SIZE)) < 0.6] = 0
    matrix[np.arange(SIZE), np.arange(SIZE)] = rng.integers(1, 99, SIZE)
    if symmetric:
        matrix = np.tril(matrix) + np.tril(matrix, -1).T
    return matrix


class Checked(Imported):
    def check(self, name, write, digits=None, suffix="", **words):
        """Requires that a symmetric stiffness, an unsymmetric friction and a mass come back."""
        rng = np.random.default_rng(len(name))
        stiffness, mass = random_matrix(1, digits=digits), np.diag(rng.integers(1, 9, SIZE) * 1.0)
        paths = [self.write(f"k{suffix}", write(stiffness)), self.write(f"m{suffix}", write(mass))]
        found = self.case(*paths, **words)
        np.testing.assert_array_equal(found["stiffness"], stiffness, name)
        np.testing.assert_array_equal(found["mass"], mass, name)
        return stiffness, mass


class Text(Checked):
    def test_abaqus(self):
        for part in ("lower", "upper", "all"):
            with self.subTest(part=part):
                self.check(part, lambda one: files.abaqus(one, part), suffix=".mtx")
                title, rows = self.rows()
                self.assertEqual(title, "row,node,component")
                self.assertEqual([row[1:] for row in rows], files.names(SIZE))

    def test_files_are_read_in_chunks(self):
        whole = reader.CHUNK
        self.addCleanup(setattr, reader, "CHUNK", whole)
        for reader.CHUNK in (100, 137, 1000):
            self.check("chunks", lambda one: files.abaqus(one, header="** a"), suffix=".mtx")
            lines = files.abaqus(np.eye(SIZE)).splitlines()
            for at in (0, 5, SIZE - 1):
                bad = [*lines[:at], "** comment", "", "1,1, 1,1, 1e", *lines[at:]]
                path = self.write("k.mtx", "\n".join(bad) + "\n")
                self.assertIn(f"k.mtx:{at + 3}: '1e'", self.refused(path, path))

    def test_abaqus_with_a_header_and_comments(self):
        head = "** a comment\n*MATRIX INPUT, NAME=K, TYPE=SYMMETRIC\n** another"
        self.check("head", lambda one: files.abaqus(one, header=head), suffix=".mtx")
        self.assertIn("2 lines of comments are not used", "; ".join(self.record.choices))

    def test_abaqus_unsymmetric(self):
        stiffness = self.write("k.mtx", files.abaqus(random_matrix(2)))
        mass = self.write("m.mtx", files.abaqus(np.eye(SIZE)))
        friction = random_matrix(3, symmetric=False)
        for part in (friction, np.triu(friction, 1), np.tril(friction, -1)):
            path = self.write("f.mtx", files.abaqus(part, "all"))
            found = self.case(stiffness, mass, ("friction", path))
            np.testing.assert_array_equal(found["friction"], part)

    def test_coordinates(self):
        for comma in (",", ", ", "  ", "\t"):
            self.check(comma, lambda one: files.coordinates(one, "lower", comma), suffix=".mtx")
        self.assertEqual(self.rows()[0], "row,row_of_file")

    def test_numbers_of_fortran(self):
        text = "1,1, 1,1, 1.5D+02\r\n1,2, 1,2, 25.-1\r\n1,3, 1,3, +.5e1\n"
        path = self.write("k.mtx", text)
        found = self.case(path, path)
        np.testing.assert_array_equal(found["mass"], np.diag([150, 2.5, 5]))

    def test_calculix(self):
        stiffness, mass, _ = files.chain(SIZE)
        names = [(7 * at + 1, at % 3 + 1) for at in range(SIZE)]
        for name, text in (
            ("a.sti", files.calculix(stiffness)),
            ("a.mas", files.calculix(mass)),
            ("a.dof", files.dof(names)),
        ):
            self.write(name, text)
        found = self.case(self.folder / "a.sti", self.folder / "a.mas")
        np.testing.assert_array_equal(found["stiffness"], stiffness)
        self.assertEqual([row[1:] for row in self.rows()[1]], names)

    def test_matrix_market(self):
        self.check("symmetric", files.matrix_market, suffix=".mtx")
        self.check("general", lambda one: files.matrix_market(one, "general"), suffix=".mtx")
        paths = [self.write(name, files.matrix_market(np.eye(SIZE))) for name in ("k", "m")]
        skew = np.triu(random_matrix(4), 1)
        skew = skew - skew.T
        path = self.write("g", files.matrix_market(skew, "skew-symmetric"))
        found = self.case(*paths, ("gyroscopic", path))
        np.testing.assert_array_equal(found["gyroscopic"], skew)

    def test_harwell_boeing(self):
        for per_line in (1, 3, 5):
            for sides in (0, 1, 2):
                with self.subTest(per_line=per_line, sides=sides):

                    def write(one):
                        return files.harwell_boeing(one, "RSA", sides, per_line)

                    self.check("hb", write)
                    said = "; ".join(self.record.choices)
                    self.assertEqual(f"{sides} right-hand sides are not used" in said, sides > 0)
        self.check("RUA", lambda one: files.harwell_boeing(one, "RUA"))
        text = files.harwell_boeing(random_matrix(5), "RUA").replace("RUA", "RSA")
        path = self.write("k", text)  # both triangles although declared symmetric
        found = self.case(path, path)
        np.testing.assert_array_equal(found["stiffness"], random_matrix(5))

    def test_harwell_boeing_with_its_mapping(self):
        names = files.names(SIZE)[::-1]
        self.write("k.mapping", files.mapping(names))
        self.check("hb", files.harwell_boeing, suffix=".matrix")
        self.assertEqual([row[1:] for row in self.rows()[1]], names)


class Nastran(Checked):
    def test_op4_text(self):
        for layout in ("dense", "sparse", "bigmat"):
            with self.subTest(layout=layout):
                self.check(layout, lambda one: files.op4_text({"KGG": one}, layout))
        self.check("two words", lambda one: files.op4_text({"KGG": one}, words=2))

    def test_op4_binary(self):
        for layout in ("dense", "sparse", "bigmat"):
            for order in "<>":
                for word in (4, 8):
                    with self.subTest(layout=layout, order=order, word=word):

                        def write(one):
                            return files.op4_binary({"KGG": one}, layout, order, word)

                        self.check(layout, write)

    def test_op4_single_precision(self):
        for layout in ("dense", "sparse", "bigmat"):
            self.check(
                layout, lambda one: files.op4_binary({"KGG": one}, layout, "<", 4, 1), digits=3
            )

    def test_op4_of_several_matrices(self):
        stiffness, friction = random_matrix(6), random_matrix(7, symmetric=False)
        three = {"KGG": stiffness, "MGG": np.eye(SIZE), "FRIC": friction}
        for name, data in (
            ("t", files.op4_text(three, "sparse", 1)),
            ("b", files.op4_binary(three, "dense", ">", form=1)),
        ):
            path = self.write(name, data)
            found = self.case(f"{path}:KGG", f"{path}:mgg", ("friction", f"{path}:FRIC"))
            np.testing.assert_array_equal(found["stiffness"], stiffness)
            np.testing.assert_array_equal(found["mass"], np.eye(SIZE))
            np.testing.assert_array_equal(found["friction"], friction)
            said = "; ".join(self.record.choices)
            self.assertIn("other matrices of the file are not used: KGG, FRIC", said)
            self.assertIn("give one as FILE:NAME: KGG, MGG, FRIC", self.refused(path, path))
            self.assertIn("no matrix KAA", self.refused(f"{path}:KAA", path))

    def test_op4_with_equal_names(self):
        first, second = random_matrix(9), random_matrix(10)
        data = files.op4_binary({"KAA": first}) + files.op4_binary({"KAA": second})
        text = files.op4_text({"KAA": first}) + files.op4_text({"KAA": second})
        for path in (self.write("b", data), self.write("t", text)):
            found = self.case(f"{path}:KAA#1", f"{path}:kaa#2")
            np.testing.assert_array_equal(found["stiffness"], first)
            np.testing.assert_array_equal(found["mass"], second)
            self.assertIn("2 matrices KAA; give one as", self.refused(f"{path}:KAA", path))
            self.assertIn("2 matrices KAA; give one as", self.refused(f"{path}:KAA#3", path))

    def test_op4_with_a_name_that_begins_with_a_digit(self):
        self.check("digit", lambda one: files.op4_text({"1MAT": one}, "bigmat"))

    def test_op4_of_partial_columns(self):
        stiffness, _, _ = files.chain(SIZE)
        stiffness[:, 4] = stiffness[4, :] = 0  # a column that the file does not have
        mass = np.eye(SIZE)
        for layout in ("dense", "sparse", "bigmat"):
            for data in (
                files.op4_text({"K": stiffness}, layout),
                files.op4_binary({"K": stiffness}, layout),
            ):
                path = self.write("k", data)
                mass_path = self.write("m", files.op4_text({"M": mass}))
                found = self.case(path, mass_path)
                np.testing.assert_array_equal(found["stiffness"], stiffness)
                self.assertIn("1 rows have no stiffness", "; ".join(self.record.choices))

    def test_dmig(self):
        for field in ("large", "small", "free"):
            with self.subTest(field=field):
                digits = 6 if field == "large" else 2
                self.check(field, lambda one: files.dmig({"KAAX": one}, field), digits)
                self.assertEqual([row[1:] for row in self.rows()[1]], files.names(SIZE))
        for form in (1, 9):
            self.check("form", lambda one: files.dmig({"KAAX": one}, "large", form), 6)

    def test_dmig_with_a_number_of_columns(self):
        """NCOL has a meaning only for rectangular matrices."""
        for form in (1, 6):
            head = f"DMIG    KAAX           0{form:8d}       2       0"
            self.check(
                "NCOL",
                lambda one: files.dmig({"KAAX": one}, "large", form).replace(
                    head, f"{head}{'':8}{SIZE:8d}"
                ),
                6,
            )

    def test_dmig_of_partial_columns(self):
        stiffness = random_matrix(8, digits=6)
        friction = np.zeros((SIZE, SIZE))
        friction[3, 7], friction[4, 7] = 2.5, -1
        path = self.write("all.pch", files.dmig({"K": stiffness, "M": np.eye(SIZE)}))
        other = self.write("f.pch", files.dmig({"F": friction}, form=1) + "GRID           1\n")
        found = self.case(f"{path}:K", f"{path}:M", ("friction", other))
        np.testing.assert_array_equal(found["friction"], friction)
        self.assertIn("1 cards GRID are not used", "; ".join(self.record.choices))

    def test_dmig_with_a_column_of_a_scalar_point(self):
        text = "DMIG,K,0,6,2\nDMIG,K,5,,,5,,2.5\nDMIG,K,7,2,,7,2,4.\n,5,,-1.\n"
        path = self.write("k.pch", text)
        found = self.case(path, path)
        np.testing.assert_array_equal(found["mass"], [[2.5, -1], [-1, 4]])
        self.assertEqual(self.rows()[1], [(1, 5, 0), (2, 7, 2)])


if __name__ == "__main__":
    unittest.main()
