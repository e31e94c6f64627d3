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
from PIL import Image
from nbclient import NotebookClient

repository = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(repository / "python"))
sys.dont_write_bytecode = True
import squeal

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")

COARSE = "n_pad_theta=6,n_free_theta=8,n_mount=1,n_plate=1,n_inside=1,n_pad_r=3,n_hat=1,n_h_ring=1"


class Notebook(unittest.TestCase):
    def test_example(self):
        with tempfile.TemporaryDirectory() as folder:
            place, soft = f"{folder}/brake", f"{folder}/soft"
            case = ["-options_file", repository / "options/disc_brake.yaml", "-quiet"]
            case += ["-modes_count", "40", "-mesh_set", COARSE]
            for words in ([place], [soft, "-material_lining_young", "1.2e9"]):
                subprocess.run(
                    [PROGRAM, *case, "-report_dir", *words], check=True, stdout=subprocess.DEVNULL
                )
            # The kernel is started by a process that inherits this; results of the user's are not
            # looked for.
            os.environ |= {
                "SQUEAL_RESULTS": place,
                "SQUEAL_VARIANT": soft,
                "SQUEAL_SLIDES": folder,
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
            self.check_slides(Path(folder), run, squeal.open(soft), said[6:])

    def check_slides(self, folder, run, soft, said):
        """The fastest mode of the last friction and its growth in the variant; the ranking."""
        self.assertIn("-material_lining_young", said[0])
        table = run.compare(soft).query("friction == 0.6")
        row = table.loc[table["growth_rate_1_per_s"].idxmax()]
        self.assertEqual((row["verdict"], row["matched_by"]), ("unstable", "MAC"))
        line = next(line for line in said[2].split("\n") if line.split()[1:2] == [str(row["mode"])])
        self.assertEqual(line.split()[-1], "MAC")
        self.assertAlmostEqual(float(line.split()[4]), row["growth_change_1_per_s"], delta=1e-3)
        largest = [one.eigenvalues["growth_rate_1_per_s"].max() for one in (run, soft)]
        quietest = "soft" if largest[1] < largest[0] else "brake"
        self.assertRegex(said[3], rf"largest growth rate +1 +{quietest}")
        for number in (1, 2, 3):
            with Image.open(folder / f"slide_{number}.png") as image:
                self.assertGreater(len(image.convert("RGB").getcolors(1 << 24)), 10)


if __name__ == "__main__":
    unittest.main(verbosity=2)
