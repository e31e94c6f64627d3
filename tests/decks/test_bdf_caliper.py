#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""A floating caliper as bulk data, against the case that it was made from: test_bdf_caliper.py
PROGRAM [MPIEXEC]. All eigenvalues agree, on one rank and on two."""
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / one) for one in ("python", "tests/support/deck", "tests/decks")]
sys.dont_write_bytecode = True
import numpy as np
import yaml
from bdf_caliper import Caliper
from caliper_case import CaliperCase
from small_decks import read_mesh

from squeal.deck.importer import import_deck


class FloatingCaliper(CaliperCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "brake.bdf").write_text(Caliper(cls.options, cls.mesh, cls.slaves).deck(0.6))
        cls.journal = import_deck(cls.folder / "brake.bdf", cls.folder / "case", speed=5.0)
        cls.case = yaml.safe_load((cls.folder / "case/case.yaml").read_text())

    def test_bodies_and_surfaces_are_complete(self):
        groups, nodes, coordinates = read_mesh(self.folder / "case/mesh.msh")
        self.assertEqual(nodes.tolist(), sorted(self.mesh.places))
        for number, (_, cells) in enumerate(sorted(self.mesh.bodies.items()), 1):
            self.assertEqual(len(groups[f"psolid_{number}"]), len(cells))
        faces = sorted(len(rows) for name, rows in groups.items() if name.startswith("bcsurf"))
        used = {
            name
            for kind in ("contact", "tie")
            for one in self.options[kind].values()
            for key, name in one.items()
            if key in ("pad", "disc", "slave", "master")
        }
        self.assertEqual(faces, sorted(len(self.mesh.faces[name]) for name in used))
        wanted = np.array([self.mesh.places[at] for at in nodes.tolist()])
        self.assertLess(np.max(np.abs(coordinates - wanted)), 1e-14)

    def test_roles_motion_and_friction(self):
        roles = [one["role"] for one in self.case["contact"].values()]
        self.assertEqual(roles, [one["role"] for one in self.options["contact"].values()])
        (motion,) = self.case["motion"].values()
        self.assertEqual((motion["speed"], motion["axis"]), (5.0, "0.0,0.0,1.0"))
        self.assertEqual(self.case["flutter"]["friction"], 0.6)

    def test_all_eigenvalues_agree(self):
        self.agree([("case", 1), ("case", 2)])


if __name__ == "__main__":
    unittest.main()
