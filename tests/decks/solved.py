# SPDX-License-Identifier: BSD-2-Clause
"""A deck, imported and solved by the program."""
import subprocess
import tempfile
from pathlib import Path

import h5py
import numpy as np
import pandas as pd

from squeal.deck.importer import import_deck


class Solved:
    """`tags`: numbers of nodes with `places` and static `displacements`, followed by rows of the
    reference nodes (displacement, then rotation); `frequencies` of the free modes; `journal`."""

    def __init__(self, program, text, files=(), **words):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            (folder / "deck.inp").write_text(text)
            for name, content in dict(files).items():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                (folder / name).write_text(content)
            self.journal = import_deck(folder / "deck.inp", folder / "case", **words)
            self.case = (folder / "case/case.yaml").read_text()
            command = [program, "-options_file", folder / "case/case.yaml", "-quiet"]
            command += ["-report_dir", folder / "results", "-checkpoint", "off"]
            run = subprocess.run(command, capture_output=True, text=True, check=False)
            if run.returncode:
                raise AssertionError(run.stdout + run.stderr)
            with h5py.File(folder / "results/results.h5") as file:
                self.tags = file["mesh/node_tag"][:].ravel()
                self.places = file["mesh/coordinates"][:]
                self.displacements = file["steady/friction_0/displacement"][:]
            self.frequencies = pd.read_csv(folder / "results/modes.csv").frequency_hz.to_numpy()

    def references(self):
        """Returns displacement and rotation of each reference node, by the order of their names."""
        return self.displacements[self.tags <= 0].reshape(-1, 2, 3)

    def at(self, places):
        """Returns the displacements of the nodes at places."""
        away = np.linalg.norm(self.places[:, None] - np.asarray(places, float), axis=2)
        assert np.all(away.min(axis=0) < 1e-9)
        return self.displacements[away.argmin(axis=0)]
