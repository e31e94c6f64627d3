#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The example notebook, run from its first cell to its last on results made here: test_notebook.py
PROGRAM."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import nbformat
from nbclient import NotebookClient

repository = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(repository / "python"))
sys.dont_write_bytecode = True
import squeal

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")

COARSE = "n_pad_theta=6,n_free_theta=8,n_mount=1,n_plate=1,n_inside=1,n_pad_r=3,n_hat=1,n_h_ring=1"


class Notebook(unittest.TestCase):
    def test_example(self):
        with tempfile.TemporaryDirectory() as place:
            subprocess.run(
                [
                    PROGRAM,
                    "-options_file",
                    repository / "options/disc_brake.yaml",
                    "-report_dir",
                    place,
                    "-quiet",
                    "-modes_count",
                    "40",
                    "-mesh_set",
                    COARSE,
                ],
                check=True,
                stdout=subprocess.DEVNULL,
            )
            # The kernel is started by a process that inherits this; results of the user's are not
            # looked for.
            os.environ |= {
                "SQUEAL_RESULTS": place,
                "PYTHONDONTWRITEBYTECODE": "1",
                "MPLBACKEND": "agg",
                "PYDEVD_DISABLE_FILE_VALIDATION": "1",
            }
            notebook = nbformat.read(repository / "python/example.ipynb", as_version=4)
            # As it is kept: without results
            self.assertFalse([cell for cell in notebook.cells if cell.get("outputs")])
            NotebookClient(
                notebook,
                timeout=120,
                kernel_name="python3",
                resources={"metadata": {"path": str(repository / "python")}},
            ).execute()
            run = squeal.open(place)
            said = [
                "".join(
                    output.get("text", "") or output.get("data", {}).get("text/plain", "")
                    for output in cell.outputs
                )
                for cell in notebook.cells
                if cell.cell_type == "code"
            ]
            self.assertEqual(said[0], repr((run.summary["case"], len(run.points), run.swept())))
            worst = run.eigenvalues.loc[run.eigenvalues["growth_rate_1_per_s"].idxmax()]
            self.assertIn(str(int(worst["mode"])), said[1].split("\n")[1].split())
            self.assertEqual(
                float(said[2].removeprefix("np.float64(").rstrip(")")),
                run.critical["friction"].min(),
            )
            self.assertIn(
                f"{worst['frequency_hz']:.2f} Hz, growth {worst['growth_rate_1_per_s']:.4g} 1/s",
                said[4],
            )
            self.assertIn("largest amplitude 1.000", said[4])  # the mode is scaled to that
            last = run.points.iloc[-1][["friction", "speed", "pressure"]]
            self.assertIn(f"{run.steady(**last)['normal_force_n'].sum():.6f}", said[5])


if __name__ == "__main__":
    unittest.main(verbosity=2)
