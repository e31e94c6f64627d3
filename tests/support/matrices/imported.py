# SPDX-License-Identifier: BSD-2-Clause
"""A test that imports matrices into the folder `case` of a folder of its own."""
import tempfile
import unittest
from pathlib import Path

import matrix_files as files

from squeal.deck.journal import DeckError
from squeal.matrices.importer import import_matrices


class InFolder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path


class Imported(InFolder):
    def case(self, stiffness, mass, *others, **words):
        """Imports matrices and returns those of the case by name."""
        out = self.folder / "case"
        roles = [("stiffness", stiffness), ("mass", mass), *others]
        self.record = import_matrices(roles, out, **words)
        return {path.stem: files.petsc(path)[0] for path in out.glob("*.petsc")}

    def rows(self):
        """Returns the title and the rows of rows.csv."""
        text = (self.folder / "case/rows.csv").read_text().splitlines()
        return text[0], [tuple(map(int, line.split(","))) for line in text[1:]]

    def refused(self, stiffness, mass, *others, **words):
        """Returns the faults with which matrices are refused."""
        with self.assertRaises(DeckError) as caught:
            self.case(stiffness, mass, *others, **words)
        account = (self.folder / "case/import.md").read_text()
        faults = [fault.strip() for fault in str(caught.exception).splitlines()[1:]]
        self.assertTrue(faults, caught.exception)
        for fault in faults:
            self.assertIn(fault, account)
        return "\n".join(faults)
