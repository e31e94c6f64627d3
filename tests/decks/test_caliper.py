#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""A floating caliper as an assembly deck, against the case that it was made from: test_caliper.py
PROGRAM [MPIEXEC]. All eigenvalues agree, on one rank and on two."""
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / one) for one in ("python", "tests/support/deck", "tests/decks")]
sys.dont_write_bytecode = True
import caliper
import numpy as np
import yaml
from caliper_case import CaliperCase
from small_decks import read_mesh

from squeal.deck.importer import import_deck


class FloatingCaliper(CaliperCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.case = cls.imported("case")

    @classmethod
    def imported(cls, name, **words):
        """Writes the deck and imports it into a folder; returns the options."""
        text, files = caliper.Caliper(cls.options, cls.mesh, cls.slaves).deck(0.6, **words)
        (cls.folder / "Parts").mkdir(exist_ok=True)
        for file, content in {"brake.inp": text, **files}.items():
            (cls.folder / file).write_text(content)
        import_deck(cls.folder / "brake.inp", cls.folder / name)
        return yaml.safe_load((cls.folder / name / "case.yaml").read_text())

    def test_bodies_and_surfaces_are_complete(self):
        groups, nodes, coordinates = read_mesh(self.folder / "case/mesh.msh")
        self.assertEqual(len(nodes), len(self.mesh.places))
        for name, cells in self.mesh.bodies.items():
            self.assertEqual(len(groups[f"{name}-1"]), len(cells))
        found = {name.split(".", 1)[1]: rows for name, rows in groups.items() if "." in name}
        for name, faces in self.mesh.faces.items():
            if name not in self.options["constraint"]:
                self.assertEqual(len(found[name]), len(faces), name)
        ordered = [
            places[np.lexsort(np.round(places, 9).T)]
            for places in (coordinates, np.array(list(self.mesh.places.values())))
        ]
        self.assertLess(np.max(np.abs(ordered[0] - ordered[1])), 1e-15)

    def test_roles_motion_and_friction(self):
        roles = [one["role"] for one in self.case["contact"].values()]
        self.assertEqual(roles, [one["role"] for one in self.options["contact"].values()])
        self.assertEqual(self.case["motion"]["disc-1"]["speed"], 5.0)
        self.assertEqual(self.case["flutter"]["friction"], "0.0:0.6:0.06")

    def test_all_eigenvalues_agree(self):
        divided = self.imported("divided", divided=("disc", "lining_inner", "caliper"))
        self.assertEqual(divided["material"]["disc-1"], {"sections": "disc-1.Lower,disc-1.Upper"})
        self.agree([("case", 1), ("case", 2), ("divided", 2)])


if __name__ == "__main__":
    unittest.main()
