#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Checks of matrices of other programs: what is refused, removed and reported."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/matrices")]
sys.dont_write_bytecode = True
import matrix_files as files
from imported import Imported

from squeal.deck.journal import DeckError
from squeal.matrices.coordinate import TRIANGLE, WHOLE

SMALL = np.array([[4.0, -1, 0], [-1, 4, -1], [0, -1, 4]])
UNIT = np.eye(3)


class Together(Imported):
    """Checks of matrices against each other."""

    def test_sizes(self):
        stiffness = self.write("k", files.matrix_market(SMALL))
        mass = self.write("m", files.matrix_market(np.eye(4)))
        self.assertIn("4 rows, but", self.refused(stiffness, mass))

    def test_headers_that_are_too_large_for_their_entries(self):
        for name, text in (
            ("k.mm", files.matrix_market(SMALL).replace("3 3 5", "2000000000 2000000000 5")),
            ("k.mtx", files.coordinates(SMALL) + "2000000000, 2000000000, 1.\n"),
        ):
            path = self.write(name, text)
            self.assertIn("2000000000 rows, but only", self.refused(path, path))

    def test_names_of_files_in_any_bytes(self):
        path = self.folder / b"k\xff\n.mtx".decode("utf-8", "surrogateescape")
        path.write_text(files.abaqus(SMALL))
        self.case(path, path)
        text = (self.folder / "case/case.yaml").read_text()
        self.assertIn("k\\udcff .mtx\n    role: stiffness", text)

    def test_rows_that_the_stiffness_does_not_have(self):
        stiffness = self.write("k.mtx", files.abaqus(SMALL))
        mass = self.write("m.mtx", files.abaqus(np.eye(5)))
        damping = self.write("d.mtx", files.abaqus(UNIT, rows=[(1, 1), (10, 2), (10, 3)]))
        faults = self.refused(stiffness, mass, ("damping", damping))
        self.assertIn("m.mtx: 2 rows or columns that the stiffness does not have", faults)
        self.assertIn("node 20 component 1; node 20 component 2", faults)
        self.assertIn("d.mtx: 1 rows or columns that the stiffness does not have: node 1", faults)

    def test_massless_rows_are_kept(self):
        stiffness = self.write("k.mtx", files.abaqus(SMALL))
        mass = self.write("m.mtx", files.abaqus(UNIT[:2, :2]))
        found = self.case(stiffness, mass)
        np.testing.assert_array_equal(found["mass"], np.diag([1, 1, 0]))
        self.assertIn("1 rows have no mass", "; ".join(self.record.choices))
        self.assertIn("node 10 component 3", "; ".join(self.record.choices))

    def test_rows_without_any_entry_are_removed(self):
        grown = np.zeros((5, 5))
        grown[1:4, 1:4] = SMALL
        mass = np.zeros((5, 5))
        mass[1:4, 1:4] = UNIT
        paths = [self.write("k", files.op4_text({"K": grown}))]
        paths.append(self.write("m", files.op4_text({"M": mass})))
        found = self.case(*paths)
        np.testing.assert_array_equal(found["stiffness"], SMALL)
        self.assertEqual(self.rows(), ("row,row_of_file", [(1, 2), (2, 3), (3, 4)]))
        omitted = (self.folder / "case/omitted_rows.csv").read_text()
        self.assertEqual(omitted, "row_of_file,reason\n1,empty\n5,empty\n")
        self.assertIn("2 rows and columns have no entry", "; ".join(self.record.choices))

    def test_rows_that_abaqus_holds_are_removed(self):
        grown = np.zeros((4, 4))
        grown[:3, :3], grown[3, 3], grown[3, 0], grown[0, 3] = SMALL, 1e36, -7, -7
        stiffness = self.write("k.mtx", files.abaqus(grown))
        mass = self.write("m.mtx", files.abaqus(np.eye(4)))
        found = self.case(stiffness, mass)
        np.testing.assert_array_equal(found["stiffness"], SMALL)
        np.testing.assert_array_equal(found["mass"], UNIT)
        omitted = (self.folder / "case/omitted_rows.csv").read_text()
        self.assertEqual(omitted, "node,component,reason\n20,1,held\n")

    def test_negative_nodes_are_kept(self):
        rows = [(-1, 1), (-1, 2), (5, 1)]
        path = self.write("k.mtx", files.abaqus(SMALL, rows=rows))
        self.case(path, path)
        self.assertEqual([row[1:] for row in self.rows()[1]], rows)

    def test_names_of_rows(self):
        paths = [self.write("k.mtx", files.coordinates(SMALL))] * 2
        table = self.write("rows.csv", "row,node,component\n1,7,2\n2,5,1\n3,6,3\n")
        self.case(*paths, rows=table)
        self.assertEqual(self.rows()[1], [(1, 7, 2), (2, 5, 1), (3, 6, 3)])
        named = self.write("d.mtx", files.abaqus(UNIT, rows=[(5, 1), (6, 3), (7, 2)]))
        found = self.case(*paths, ("damping", named), rows=table)
        np.testing.assert_array_equal(found["damping"], UNIT)
        self.assertIn("give the nodes by --rows", self.refused(*paths, ("damping", named)))
        for text, words in (
            ("1,7,2\n2,5,1\n", "table.csv has names for 2"),
            ("1,7,2\n2,7,2\n3,6,3\n", "node 7 component 2 occurs twice"),
            ("1,7,2\n3,5,1\n", "table.csv:2: equation 3 follows 1"),
            ("1,7,2\n2,5\n", "table.csv:2"),
            ("1,7,FLUX\n", "unknown degree of freedom"),
            ("1,7,2", "cut short"),
        ):
            table = self.write("table.csv", text)
            self.assertIn(words, self.refused(*paths, rows=table))

    def test_cyclic_symmetry_of_calculix(self):
        self.write("a.sti", files.calculix(np.eye(4)))
        self.write("a.mas", files.calculix(np.eye(4)))
        self.write("a.dof", files.dof([(1, 1), (2, 1)]))
        self.assertIn("cyclic", self.refused(self.folder / "a.sti", self.folder / "a.mas"))

    def test_the_folder_of_another_case_is_left_alone(self):
        path = self.write("k.mtx", files.abaqus(SMALL))
        (self.folder / "case").mkdir()
        self.write("case/case.yaml", "mesh:\n")
        with self.assertRaisesRegex(DeckError, "not made by squeal-import"):
            self.case(path, path)
        self.write("case/case.yaml", "# Made by squeal-import from x.inp\n")
        self.write("case/mesh.msh", "")
        self.case(path, path)
        self.assertFalse((self.folder / "case/mesh.msh").exists())


class Entries(Imported):
    """Checks of the entries of a file."""

    def refused_text(self, text, name="k.mtx"):
        path = self.write(name, text)
        return self.refused(path, self.write("m.mtx", files.abaqus(UNIT)))

    def test_duplicates_are_summed(self):
        path = self.write("k.mtx", files.abaqus(SMALL) + "10,1, 10,1, 0.5\n10,1, 10,1, 0.25\n")
        found = self.case(path, path)
        self.assertEqual(found["stiffness"][0, 0], 4.75)
        self.assertIn("2 entries of the same place are summed", "; ".join(self.record.choices))

    def test_values(self):
        good = "1,1, 1,1, 4.\n"
        for bad in ("nan", "inf", "1e999", "1.2.3", "", "--1", "1e", "0x1", "1_0", "4,5", "é"):
            faults = self.refused_text(f"{good}1,2, 1,2, {bad}\n")
            self.assertIn("k.mtx:2: ", faults, bad)
        for bad in (
            "1,1, 1,,1, 4.",
            "1 1 1 1 4.",
            "1,1, 1,1.5, 4.",
            "0,1, 0,1, 4.",
            "1,77, 1,1, 4.",
        ):
            self.assertIn("k.mtx:2: ", self.refused_text(f"{good}{bad}\n"), bad)
        self.assertIn("k.mtx:2: the file ends within a line", self.refused_text(good + "1,2, 1,2"))
        self.assertIn("empty", self.refused_text(""))
        self.assertIn("no entry", self.refused_text("** nothing\n"))

    def test_forms(self):
        mixed = SMALL.copy()
        mixed[0, 1] = 0
        path, mass = self.write("k.mtx", files.abaqus(mixed, "all")), self.write(
            "m.mtx", files.abaqus(UNIT)
        )
        faults = self.refused(path, mass)
        self.assertIn("2 of 3 entries off the diagonal are in both triangles", faults)
        self.assertIn("--whole stiffness", faults)
        found = self.case(path, mass, forms={"stiffness": WHOLE})
        np.testing.assert_array_equal(found["stiffness"], mixed)
        path = self.write("k.mtx", files.abaqus(SMALL, "lower"))
        found = self.case(path, mass, forms={"stiffness": WHOLE})
        np.testing.assert_array_equal(found["stiffness"], np.tril(SMALL))
        self.assertIn("half of a symmetric matrix", self.refused(path, mass, ("friction", path)))
        two = (("friction", path), ("friction", path))
        found = self.case(path, mass, *two, forms={"friction": TRIANGLE, "friction_2": WHOLE})
        np.testing.assert_array_equal(found["friction"], SMALL)
        np.testing.assert_array_equal(found["friction_2"], np.tril(SMALL))
        head = "*MATRIX INPUT, TYPE=SYMMETRIC"
        for text, words in (
            (files.abaqus(SMALL + np.triu(SMALL, 1), "all", header=head), "two triangles differ"),
            (files.abaqus(mixed, "all", header=head), "neither a triangle nor"),
        ):
            self.assertIn(words, self.refused(self.write("k.mtx", text), mass))
        path = self.write("k.mtx", files.abaqus(SMALL, header=head))
        self.assertIn("declared symmetric", self.refused(path, mass, forms={"stiffness": WHOLE}))

    def test_coordinates_with_a_line_of_sizes(self):
        path = self.write("k.mtx", "3, 3, 5\n" + files.coordinates(SMALL))
        self.assertIn("the first line is one of sizes", self.refused(path, path))

    def test_keywords_of_abaqus(self):
        body = files.abaqus(SMALL)
        for head, words in (
            ("*CLOAD, REAL", "*CLOAD is not supported; the import needs the assembled matrix"),
            ("*MATRIX,TYPE=STIFFNESS", "*MATRIX is not supported; the import needs the assembled"),
            ("*MATRIX INPUT, NAME=K, SCALE FACTOR=2.", "SCALEFACTOR=2. is not supported"),
            ("*MATRIX INPUT, NAME=K\n*MATRIX INPUT, NAME=M", "k.mtx:2: a second matrix"),
        ):
            self.assertIn(words, self.refused_text(f"{head}\n{body}"))

    def test_files_that_are_cut_short(self):
        """Every file with its number of entries is refused wherever it ends."""
        wholes = {
            "k.op4": files.op4_binary({"K": SMALL}, "bigmat").ljust(1),
            "k.txt": files.op4_text({"K": SMALL}, "sparse").encode(),
            "k.hb": files.harwell_boeing(SMALL, sides=1).encode(),
            "k.mm": files.matrix_market(SMALL).encode(),
            "k.sti": files.calculix(SMALL).encode(),
        }
        for name, whole in wholes.items():
            self.case(self.write(name, whole), self.write("m", files.matrix_market(UNIT)))
            for length in range(len(whole)):
                path = self.write(name, whole[:length])
                with self.assertRaises(DeckError, msg=f"{name} {length}") as caught:
                    self.case(path, self.folder / "m")
                self.assertIn(name, str(caught.exception))


class Formats(Imported):
    """What single formats cannot honour."""

    def refused_file(self, data, *words):
        path = self.write("k", data)
        faults = self.refused(path, self.write("m", files.matrix_market(UNIT)))
        for word in words:
            self.assertIn(word, faults)

    def test_matrix_market(self):
        text = files.matrix_market(SMALL)
        for old, new, words in (
            ("real", "complex", "entries of the type complex"),
            ("real", "pattern", "entries of the type pattern"),
            ("symmetric", "hermitian", "the symmetry hermitian"),
            ("coordinate", "array", "arrays are not supported"),
            ("3 3 5", "3 3 4", "5 entries, but the line of sizes says 4"),
            ("3 3 5", "3 4 5", "k:3: 3 rows and 4 columns"),
            ("3 3 5", "2 2 5", "not in the matrix"),
        ):
            self.refused_file(text.replace(old, new, 1), words)

    def test_harwell_boeing(self):
        text = files.harwell_boeing(SMALL, sides=1)
        for old, new, words in (
            ("RSA", "CSA", "k:3: CSA: complex entries are not supported"),
            ("RSA", "PSA", "a pattern without values"),
            ("RSA", "RSE", "not assembled"),
            ("RSA", "RRA", "rectangular matrices"),
            ("RSA", "RHA", "Hermitian"),
            ("(1I14)", "(A2I14)"[:6], "not a format of numbers"),
            ("(1D24.16)", "(1PD24.16)"[:9], "not a format of numbers"),
            ("F  ", "M  ", "right-hand sides of the type"),
        ):
            self.refused_file(text.replace(old, new, 1), words)
        self.refused_file(text + "1\n", "lines follow")
        lines = text.splitlines()
        lines[5] = f"{0:14d}"
        self.refused_file("\n".join(lines) + "\n", "the pointers do not begin with 1")

    def test_op4(self):
        rng = np.random.default_rng(1)
        for layout in ("dense", "sparse", "bigmat"):
            complex_text = files.op4_text({"K": SMALL}).replace(f"{6:8d}{2:8d}", f"{6:8d}{4:8d}")
            self.refused_file(complex_text, "K: complex matrices are not supported")
            data = files.op4_binary({"K": SMALL}, layout, form=3)
            self.refused_file(data, "the form 'diagonal' is not supported")
            data = files.op4_binary({"K": SMALL * np.nan}, layout)
            self.refused_file(data, "byte ", "not a finite number")
        self.refused_file(files.op4_binary({"K": SMALL}, kind=3), "complex matrices")
        data = bytearray(files.op4_binary({"K": rng.random((3, 3))}))
        data[-4] ^= 1
        self.refused_file(bytes(data), "the end of the record does not repeat its length")

    def test_dmig(self):
        text = files.dmig({"K": SMALL})
        head = "DMIG    K              0       6       2       0"
        self.assertIn(head, text)
        for new, words in (
            ("DMIG    K              0       6       4       0", "K: complex matrices"),
            ("DMIG    K              0       2       2       0", "numbers of columns"),
            ("DMIG    K              0       9       2       0" + f"{'':16}{3:8d}", "numbers of"),
            ("DMIG    K              0       7       2       0", "IFO 7 is unknown"),
            ("$", "K has no header"),
            (head + "\n" + head, "k:3: a second header"),
        ):
            self.refused_file(text.replace(head, new), words)
        star = "*                     10               1 4.000000000E+00\n"
        self.assertIn(star, text)
        for new, words in (
            (star[:-17] + " 4.000000000E+00 1.00000000E+00\n", "an imaginary part"),
            (
                star.replace("4.000000000E+00", "4              "),
                "not a finite number with a point",
            ),
            (star.replace(" 1 4", " 9 4"), "10, 9 is not a node and component"),
            ("*\n", "is not an integer"),
        ):
            self.refused_file(text.replace(star, new, 1), words)
        self.refused_file("*" + text, "a continuation without its card")

    def test_files_of_other_kinds(self):
        self.refused_file(b"\x89HDF\r\n\x1a\n", "HDF5 file, which the program reads")
        self.refused_file("a poem\n", "the format is not known")
        self.assertIn("No such file", self.refused(self.folder / "none", self.folder / "none"))


if __name__ == "__main__":
    unittest.main()
