# SPDX-License-Identifier: BSD-2-Clause
"""scripts/convert_matrix: what comes out is what went in, bit for bit, and what is damaged is
refused in one line."""
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy
import scipy.io
import scipy.sparse

SCRIPT = Path(__file__).parents[2] / "scripts" / "convert_matrix"
SAMPLE = numpy.array([[1 / 3, 0, -2e-310], [0, 0.1, 0], [1e300, 0, numpy.nextafter(1, 2)]])


class ConvertMatrix(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_script(self, source, target):
        return subprocess.run([SCRIPT, source, target], capture_output=True, text=True, check=False)

    def expect_refused(self, name, *words):
        run = self.run_script(self.folder / name, self.folder / "out.mtx")
        self.assertEqual(run.returncode, 1, name)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)
        self.assertEqual([path.name for path in self.folder.glob("out*")], [])

    def test_bit_for_bit(self):
        scipy.sparse.save_npz(self.folder / "k.npz", scipy.sparse.csc_matrix(SAMPLE))
        numpy.save(self.folder / "k.npy", SAMPLE)
        for source in ("k.npz", "k.npy"):
            run = self.run_script(self.folder / source, self.folder / "k.mtx")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            numpy.testing.assert_array_equal(
                scipy.io.mmread(self.folder / "k.mtx").toarray(), SAMPLE
            )
            run = self.run_script(self.folder / source, self.folder / "k.h5")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            with h5py.File(self.folder / "k.h5") as file:
                lists = tuple(file[name][:] for name in ("data", "indices", "indptr"))
                numpy.testing.assert_array_equal(scipy.sparse.csr_matrix(lists).toarray(), SAMPLE)
                self.assertEqual(file.attrs["format"], "csr")  # squeal wants the layout said

    def test_harwell_boeing_cut_short(self):
        whole = self.folder / "k.rb"
        matrix = scipy.sparse.csc_matrix(numpy.array([[2, 0], [1, 1 / 3]]))
        scipy.io.hb_write(whole, matrix)
        self.assertEqual(self.run_script(whole, self.folder / "k.mtx").returncode, 0)
        numpy.testing.assert_allclose(
            scipy.io.mmread(self.folder / "k.mtx").toarray(), matrix.toarray(), rtol=1e-15
        )
        text = whole.read_text()
        last = text.rindex("3.33")
        # Within the exponent and the digits of the last value, behind a whole one, and behind a
        # whole line.
        for length in (
            len(text) - 1,
            len(text) - 2,
            last + 9,
            last,
            text.rindex("\n", 0, last),
            text.rindex("\n", 0, last) + 1,
        ):
            (self.folder / "cut.rb").write_text(text[:length])
            run = self.run_script(self.folder / "cut.rb", self.folder / "cut.mtx")
            self.assertEqual(run.returncode, 1, length)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_refusals(self):
        scipy.sparse.save_npz(self.folder / "whole.npz", scipy.sparse.eye(5, format="csr"))
        (self.folder / "cut.npz").write_bytes((self.folder / "whole.npz").read_bytes()[:300])
        lists = {
            "format": numpy.array(b"csr"),
            "data": numpy.array([1.0, 2, 3]),
            "shape": numpy.array([2, 2]),
        }
        numpy.savez(
            self.folder / "negative.npz",
            indices=numpy.array([0, -5, 1]),
            indptr=numpy.array([0, 1, 3]),
            **lists,
        )
        numpy.savez(
            self.folder / "beyond.npz",
            indices=numpy.array([0, 7, 1]),
            indptr=numpy.array([0, 1, 3]),
            **lists,
        )
        numpy.savez(
            self.folder / "long.npz",
            indices=numpy.array([0, 0, 1]),
            indptr=numpy.array([0, 1, 9]),
            **lists,
        )
        numpy.save(self.folder / "complex.npy", SAMPLE * 1j)
        numpy.save(self.folder / "logical.npy", SAMPLE > 0)
        numpy.save(self.folder / "text.npy", numpy.array([["a", "b"], ["c", "d"]]))
        numpy.save(self.folder / "wide.npy", SAMPLE[:2])
        numpy.save(self.folder / "vector.npy", SAMPLE[0])
        numpy.save(self.folder / "nan.npy", SAMPLE * numpy.nan)
        for name, word in (
            ("cut.npz", "zip"),
            ("negative.npz", "negative"),
            ("beyond.npz", "index"),
            ("long.npz", "index"),
            ("complex.npy", "complex"),
            ("logical.npy", "bool"),
            ("text.npy", "<U1"),
            ("wide.npy", "2 rows and 3"),
            ("vector.npy", "1 dimensions"),
            ("nan.npy", "not a finite number"),
            ("none.npy", "No such file"),
        ):
            self.expect_refused(name, name, word)


if __name__ == "__main__":
    unittest.main()
