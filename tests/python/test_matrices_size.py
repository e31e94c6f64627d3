#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""A stiffness of ten million lines in Abaqus' format: time, memory and the sum of its entries."""
import resource
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
SIZE, BAND = 420000, 24
MOST_SECONDS, MOST_BYTES = 180, 4e9  # an idle machine takes a quarter of this time


class Large(unittest.TestCase):
    def test_ten_million_lines(self):
        with tempfile.TemporaryDirectory() as folder:
            total = self.write(Path(folder))
            command = [repository / "scripts/squeal-import", "--stiffness", "k.mtx"]
            started = time.monotonic()
            run = subprocess.run([*command, "--mass", "m.mtx"], cwd=folder, check=False)
            elapsed = time.monotonic() - started
            self.assertEqual(run.returncode, 0)
            self.assertLess(elapsed, MOST_SECONDS)
            peak = 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
            self.assertLess(peak, MOST_BYTES)
            print(f"{elapsed:.0f} s, {peak / 1e9:.1f} GB")
            account = (Path(folder) / "k/import.md").read_text()
            row = next(one for one in account.splitlines() if one.startswith("| stiffness |"))
            cells = [cell.strip() for cell in row.split("|")]
            self.assertEqual(int(cells[8]), 2 * int(cells[5]) - SIZE)
            self.assertAlmostEqual(float(cells[9]), total, delta=1e-9 * SIZE)

    def write(self, folder):
        """Writes a band matrix, its lower triangle, and a unit mass; returns the sum of all entries
        of the first."""
        rng = np.random.default_rng(3)
        total = 0.0
        with open(folder / "k.mtx", "w", encoding="ascii") as file:
            for first in range(0, SIZE, 20000):
                rows = np.repeat(np.arange(first, first + 20000), BAND)
                columns = rows - np.tile(np.arange(BAND), 20000)
                rows, columns = rows[columns >= 0].tolist(), columns[columns >= 0].tolist()
                values = rng.random(len(rows)).tolist()
                total += sum(v * (1 if i == j else 2) for i, j, v in zip(rows, columns, values))
                file.write(
                    "".join(
                        f"{i // 3 + 1},{i % 3 + 1}, {j // 3 + 1},{j % 3 + 1}, {v:.16e}\n"
                        for i, j, v in zip(rows, columns, values)
                    )
                )
        with open(folder / "m.mtx", "w", encoding="ascii") as file:
            for i in range(SIZE):
                file.write(f"{i // 3 + 1},{i % 3 + 1}, {i // 3 + 1},{i % 3 + 1}, 1.0\n")
        return total


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
