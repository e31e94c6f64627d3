#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The package squeal, on the results of two runs made here: test_results.py PROGRAM."""
import csv
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

repository = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(repository / "python"))
sys.dont_write_bytecode = True
import squeal

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder, cls.slabs, cls.matrices, cls.chain = (
            Path(temporary.name) / name for name in ("layers", "slabs", "external", "chain")
        )
        for case, folder, words in (
            (
                "two_layers",
                cls.folder,
                [
                    "-mesh_set",
                    "nx=6,ny_disc=2,ny_pad=2,order=2",
                    "-modes_count",
                    "40",
                    "-flutter_pressure",
                    "1,2",
                ],
            ),
            (
                "two_layers_antiplane",
                cls.slabs,
                ["-mesh_set", "nx=4,ny_disc=2,ny_pad=2,order=2", "-modes_count", "30"],
            ),
            ("external", cls.matrices, []),
            (
                "external_chain",
                cls.chain,
                ["-flutter_method", "direct", "-flutter_unstable_tolerance", "0.1"],
            ),
        ):
            subprocess.run(
                [
                    PROGRAM,
                    "-options_file",
                    repository / f"options/{case}.yaml",
                    "-report_dir",
                    folder,
                    "-quiet",
                    *words,
                ],
                check=True,
                stdout=subprocess.DEVNULL,
            )
        cls.run_ = squeal.open(cls.folder)

    def test_tables(self):
        run, table = self.run_, rows(self.folder / "eigenvalues.csv")
        self.assertEqual(len(run.eigenvalues), len(table))
        for index in (0, len(table) // 2, -1):
            found = run.eigenvalues.iloc[index]
            self.assertEqual(
                found["s"],
                complex(
                    float(table[index]["growth_rate_1_per_s"]),
                    float(table[index]["angular_frequency_rad_per_s"]),
                ),
            )
            self.assertEqual(found["verdict"], table[index]["verdict"])
        self.assertEqual(
            int(run.eigenvalues["grows"].sum()), sum(row["verdict"] == "unstable" for row in table)
        )
        self.assertEqual(run.swept(), ["friction", "pressure"])
        self.assertEqual(len(run.points), len(rows(self.folder / "stability_map.csv")))
        self.assertIsNone(run.sensitivities)
        self.assertIsNone(squeal.open(self.matrices).friction_work)

    def test_what_grows_is_what_the_program_counts_as_unstable(self):
        """Of uncertified eigenvalues too, of which some grow by less than
        -flutter_unstable_tolerance."""
        for folder in (self.folder, self.matrices, self.chain):
            run = squeal.open(folder)
            counted = run.eigenvalues.groupby(list(squeal.PARAMETERS))["grows"].sum()
            self.assertEqual(
                counted.tolist(),
                run.stability_map.set_index(list(squeal.PARAMETERS))["unstable_modes"][
                    counted.index
                ].tolist(),
            )
            listed = [len(point["unstable_modes"]) for point in run.summary["frictions"]]
            self.assertEqual(sorted(counted), sorted(listed))
        table = squeal.open(self.chain).eigenvalues  # the last of them
        self.assertEqual(set(table["verdict"]), {"uncertified"})
        slow = ~table["grows"] & (table["growth_rate_1_per_s"] > 1e-3 * table["s"].abs())
        self.assertTrue(slow.any() and table["grows"].any())

    def test_steady_tables_by_parameters(self):
        table = self.run_.steady(friction=0.3, pressure=2)
        self.assertEqual(len(table), len(rows(self.folder / "steady_0.3_pressure_2.csv")))
        with self.assertRaisesRegex(
            squeal.ResultsError, "2 points of the sweep have friction 0.3; name one"
        ):
            self.run_.steady(friction=0.3)
        with self.assertRaisesRegex(squeal.ResultsError, "0 points of the sweep have friction 0.7"):
            self.run_.steady(friction=0.7)
        with self.assertRaisesRegex(
            squeal.ResultsError, "temperature is not a parameter of a sweep: friction, speed"
        ):
            self.run_.steady(temperature=20)

    def test_modes(self):
        mode = self.run_.fastest_mode(friction=0.5, pressure=2)
        kept = self.run_.kept_modes().query("friction == 0.5 and pressure == 2")
        # Tables hold sixteen digits, results.h5 the numbers themselves.
        self.assertAlmostEqual(
            mode.growth, kept["growth_rate_1_per_s"].max(), delta=1e-15 * abs(mode.s)
        )
        listed = self.run_.eigenvalues.query(
            f"friction == 0.5 and pressure == 2 and mode == {mode.number}"
        ).iloc[0]
        self.assertAlmostEqual(abs(mode.s - listed["s"]), 0, delta=1e-14 * abs(mode.s))
        self.assertAlmostEqual(mode.frequency, listed["frequency_hz"], delta=1e-12 * mode.frequency)
        np.testing.assert_allclose(mode.displacement(np.pi), -mode.displacement(0), atol=1e-15)
        size = np.linalg.norm(np.abs(mode.shape), axis=1).max()  # Re(d exp(i π/2)) = −Im d
        np.testing.assert_allclose(
            mode.displacement(np.pi / 2)[:, : mode.shape.shape[1]],
            -mode.shape.imag / size,
            atol=1e-15,
        )
        self.assertAlmostEqual(
            np.linalg.norm(mode.displacement(0) + 1j * mode.displacement(-np.pi / 2), axis=1).max(),
            1,
            delta=1e-14,
        )
        with self.assertRaisesRegex(
            squeal.ResultsError, "no shape of mode 999 was kept at friction 0.5, pressure 2"
        ):
            self.run_.mode(999, friction=0.5, pressure=2)

    def test_grids_are_those_that_the_program_writes_for_paraview(self):
        """Cells in VTK's order of nodes: those of the .pvtu, of elements of second order here, cell
        by cell."""
        for folder, nodes in ((self.folder, 9), (self.slabs, 20)):
            reader = vtkXMLPUnstructuredGridReader()
            reader.SetFileName(str(next((folder / "vtk").glob("steady*.pvtu"))))
            reader.Update()
            found = squeal.open(folder).grid()
            self.assertGreaterEqual(found.GetCell(0).GetNumberOfPoints(), nodes)
            self.assertEqual(self.cells(found), self.cells(reader.GetOutput()))

    @staticmethod
    def cells(grid):
        """Types of the cells and places of their nodes in their order."""
        places = vtk_to_numpy(grid.GetPoints().GetData())
        of_cell = [
            [grid.GetCell(i).GetPointId(k) for k in range(grid.GetCell(i).GetNumberOfPoints())]
            for i in range(grid.GetNumberOfCells())
        ]
        return sorted(
            (grid.GetCellType(i), np.round(places[of_cell[i]], 9).tolist())
            for i in range(len(of_cell))
        )

    def test_grids_of_modes_hold_their_displacement(self):
        mode = self.run_.fastest_mode(friction=0.5, pressure=1)
        moved = vtk_to_numpy(mode.grid(0.3).GetPointData().GetArray("displacement"))
        np.testing.assert_array_equal(moved, mode.displacement(0.3))

    def test_shares_of_the_components_are_those_of_the_tables(self):
        table = self.run_.components
        table = table[(table["friction"] == 0.5) & (table["pressure"] == 2)]
        with h5py.File(self.folder / "results.h5") as file:
            found = file["flutter/friction_0.5_pressure_2/components"]
            names = found.attrs["components"].decode().split(",")
            columns = found.attrs["columns"].decode().split(",")
            rows = [dict(zip(columns, row)) for row in found[()]]
            free = file["modes/active_set_1/components"][()]
        self.assertEqual(len(rows), len(table))
        for row, wanted in zip(rows, table.to_dict("records")):
            name = f"{wanted['kind']} {wanted['component']}"
            self.assertEqual(names[int(row["component"])], name)
            self.assertEqual(int(row["mode"]), wanted["mode"])
            for column in ("strain_share", "kinetic_share", "follower_1_per_s"):
                # The table has ten digits of the growth rates.
                np.testing.assert_allclose(row[column], wanted[column], rtol=1e-9, atol=1e-15)
        for mode in np.unique(free[:, 0]):
            for column in (2, 3):
                self.assertAlmostEqual(free[free[:, 0] == mode, column].sum(), 1, delta=1e-12)

    def test_matrices_have_vectors_but_no_mesh(self):
        run = squeal.open(self.matrices)
        mode = run.fastest_mode(friction=1.2)
        with h5py.File(self.matrices / "results.h5") as file:
            np.testing.assert_array_equal(
                mode.shape.real, file[f"flutter/friction_1.2/mode_{mode.number:03d}_real"][()]
            )
        self.assertIsNone(run.mesh)
        with self.assertRaisesRegex(squeal.ResultsError, "no mesh"):
            run.grid()

    def test_incomplete_results_are_refused_by_name(self):
        with self.assertRaisesRegex(
            squeal.ResultsError, "/nowhere holds no complete results: there is no summary.json"
        ):
            squeal.open("/nowhere")
        for text, message in (
            ("{}", "`version` is missing"),
            ("[]", "it is not an object"),
            ('{"version": "0.1.0"}', "`complete` is missing"),
            (
                (
                    '{"version": "0.1.0", "complete": true, "options":'
                    ' {"flutter_unstable_tolerance": "x"}}'
                ),
                "is not a number",
            ),
        ):
            with tempfile.TemporaryDirectory() as empty:
                (Path(empty) / "summary.json").write_text(text)
                with self.assertRaisesRegex(
                    squeal.ResultsError, f"summary.json is not a summary of a run: .*{message}"
                ):
                    squeal.open(empty)
                # The commands that read results say the same in one line, and add no file.
                for command in (["squeal-report"], ["squeal-plot"], ["squeal-plot", "mode"]):
                    name, *words = command
                    failed = subprocess.run(
                        [repository / "scripts" / name, *words, empty],
                        capture_output=True,
                        text=True,
                    )
                    self.assertEqual(
                        (failed.returncode, len(failed.stderr.splitlines())), (1, 1), failed.stderr
                    )
                    self.assertIn(message, failed.stderr)
                self.assertEqual([path.name for path in Path(empty).iterdir()], ["summary.json"])
        copy = self.folder.parent / "copy"
        shutil.copytree(self.folder, copy, ignore=shutil.ignore_patterns("vtk", "results.h5"))
        whole = (copy / "eigenvalues.csv").read_text()
        (copy / "eigenvalues.csv").write_text(whole[: len(whole) // 2])
        with self.assertRaisesRegex(squeal.ResultsError, "eigenvalues.csv: line [0-9]+ is cut"):
            squeal.open(copy)
        (copy / "eigenvalues.csv").write_text("friction,speed\n0,1\n")
        with self.assertRaisesRegex(
            squeal.ResultsError, "eigenvalues.csv: there is no column pressure, damping, mode"
        ):
            squeal.open(copy)
        (copy / "eigenvalues.csv").write_text(whole)
        with self.assertRaisesRegex(squeal.ResultsError, "results.h5 is missing"):
            squeal.open(copy).mesh


if __name__ == "__main__":
    unittest.main(verbosity=2)
