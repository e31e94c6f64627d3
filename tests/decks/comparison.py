# SPDX-License-Identifier: BSD-2-Clause
"""A deck solved by CalculiX and, imported, by this program: differences of the results."""
import subprocess
from pathlib import Path

import ccx
import h5py
import numpy as np
import pandas as pd

from squeal.deck.case.groups import NODES
from squeal.deck.case.roles import Roles
from squeal.deck.case.translate import translate
from squeal.deck.importer import import_deck
from squeal.deck.inp.dialect import CALCULIX
from squeal.deck.inp.reader import read_model
from squeal.deck.journal import Journal


class Comparison:
    """Runs both programs in a folder of their own."""

    def __init__(self, program, text, folder, ignored=(), dialect=None):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.path = self.folder / "deck.inp"
        self.path.write_text(text, encoding="latin-1")
        self.reference = ccx.Reference(text, self.folder / "ccx")
        import_deck(self.path, self.folder / "case", dialect, ignored)
        journal = Journal(ignored)
        self.model = read_model(self.path, CALCULIX, journal)
        self.case = translate(self.model, journal)
        run = subprocess.run(
            [program, "-options_file", self.folder / "case/case.yaml", "-quiet"]
            + ["-report_dir", self.folder / "results", "-checkpoint", "off"],
            capture_output=True,
            text=True,
            check=False,
        )
        if run.returncode:
            raise AssertionError(f"{self.folder.name}: {run.stdout}{run.stderr}")
        self.text = text

    def displacements(self):
        """Returns for each component the largest difference over the largest value."""
        return _relative(*self.both_displacements())

    def both_displacements(self):
        """Returns the displacements of the program and those of CalculiX, a row for each node."""
        with h5py.File(self.folder / "results/results.h5") as file:
            tags = file["mesh/node_tag"][:].ravel()
            found = file["steady/friction_0/displacement"][:]
        found, tags = found[tags >= -1], tags[tags >= -1]  # without the nodes of soft layers
        numbers = [*tags[tags > 0].tolist(), *self._reference_nodes()]
        assert len(numbers) == len(found)
        kept = [at for at, number in enumerate(numbers) if number is not None]
        wanted = np.array([self.reference.displacements[numbers[at]] for at in kept])
        return found[kept], wanted

    def _reference_nodes(self):
        """Returns the nodes of the deck whose components are the displacement and the rotation of
        each reference node, None where there is none: they follow the mesh in results.h5."""
        roles = Roles(self.model, self.case, Journal())
        rows = []
        for name in sorted(self.case.options.get("reference", {})):
            for table in (roles.references, roles.rotations):
                rows.append(next((number for number, one in table.items() if one == name), None))
        return rows

    def frequencies(self):
        found = pd.read_csv(self.folder / "results/modes.csv").frequency_hz.to_numpy()
        wanted = self.reference.frequencies
        assert len(found) >= len(wanted) > 0
        return float(np.max(np.abs(found[: len(wanted)] - wanted) / wanted))

    def reactions(self):
        """Returns the largest difference of the forces of supports on groups of nodes over the
        largest force of a node or a group, and that of moments over the same times the size of the
        model."""
        table = pd.read_csv(self.folder / "results/reactions.csv")
        table = table[table.kind == "support"].set_index("name")
        nodal = self._nodal_reactions(self._supports())
        forces = [*self.reference.forces.values(), *(one.sum(axis=0) for one in nodal.values())]
        largest = max(np.max(np.abs(force)) for force in forces)
        size = np.max(np.abs(self.model.nodes.coordinates))
        force = moment = 0.0
        for name, forces in nodal.items():
            places = self.model.nodes.at(self.case.groups[NODES][name])
            row = table.loc[name]
            found = row[["force_x_n", "force_y_n", "force_z_n"]].to_numpy(float)
            force = max(force, np.max(np.abs(found - forces.sum(axis=0))) / largest)
            found = row[["moment_x_n_m", "moment_y_n_m", "moment_z_n_m"]].to_numpy(float)
            wanted = np.cross(places, forces).sum(axis=0)
            moment = max(moment, np.max(np.abs(found - wanted)) / (largest * size))
        return force, moment

    def _supports(self):
        return {
            name: options
            for name, options in self.case.options["constraint"].items()
            if name in self.case.groups[NODES]
        }

    def _nodal_reactions(self, supports):
        """Returns the reactions of the nodes of each support in global axes, one row each."""
        held = {one for name in supports for one in self.case.groups[NODES][name].tolist()}
        state, loads = self.model.state, {}
        if state.pressures or state.body_loads or set(state.forces) & set(state.supports):
            text = ccx.held_elsewhere(self.text, held)
            loads = ccx.Reference(text, self.folder / "ccx_loads").forces
        found = {}
        for name, options in supports.items():
            components = ["xyz".index(one) for one in options["clamped"][0]]
            rows = []
            for number in self.case.groups[NODES][name].tolist():
                frame = self.model.frames.get(number)
                place = self.model.nodes.at([number])[0]
                axes = (np.eye(3) if frame is None else frame.axes_at(place))[components]
                force = self.reference.forces[number] - loads.get(number, np.zeros(3))
                rows.append(axes.T @ (axes @ force))
            found[name] = np.array(rows)
        return found


def _relative(found, wanted):
    """Columns that are round-off are compared with the largest value of all."""
    largest = np.max(np.abs(wanted), axis=0)
    largest = np.where(largest > 1e-9 * np.max(largest), largest, np.max(largest))
    return float(np.max(np.abs(found - wanted) / largest))
