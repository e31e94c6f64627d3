# SPDX-License-Identifier: BSD-2-Clause
"""Finds the format of a file by its content, and reads it."""
import re
from pathlib import Path

from squeal.deck.journal import Fault
from squeal.matrices import abaqus, calculix, dmig, harwell_boeing, matrix_market
from squeal.matrices import op4_binary, op4_text

HEAD = 1 << 16  # bytes that are enough for a header, or for the first lines of entries
# Formats that the program reads by itself: first bytes, name.
OWN = (
    (b"\x89HDF", "HDF5"),
    (b"MATLAB", "MATLAB"),
    (b"\x00\x12\x7bP", "PETSc binary"),
)
NASTRAN = (".pch", ".bdf", ".dat", ".nas", ".asm", ".blk")


def shown(path):
    """Returns a path as text that can be printed, whatever bytes its name has."""
    return " ".join(str(path).encode("utf-8", "backslashreplace").decode().split())


class Source:
    """A file of the command line, PATH or PATH:NAME for one of several matrices."""

    def __init__(self, word):
        word = str(word)
        self.path, self.name = Path(word), ""
        head, colon, name = word.rpartition(":")
        if not self.path.is_file() and colon and Path(head).is_file():
            self.path, self.name = Path(head), name

    def __str__(self):
        return f"{shown(self.path)}:{self.name}" if self.name else shown(self.path)

    def read(self):
        """Returns the matrix. Raises Fault."""
        try:
            with open(self.path, "rb") as file:
                head = file.read(HEAD)
        except OSError as error:
            raise Fault(error.strerror) from None
        reader, several = self._reader(head)
        if several:
            return reader(self.path, self.name)
        if self.name:
            raise Fault(f"a file of this format has one matrix, without a name like {self.name}")
        return reader(self.path)

    def _reader(self, head):
        """Returns a function that reads the file, and whether it takes the name of a matrix."""
        for first, name in OWN:
            if head.startswith(first):
                raise Fault(f"a {name} file, which the program reads: -matrices_<name>_file")
        if not head:
            raise Fault("the file is empty")
        lines, suffix = _lines(head), self.path.suffix.lower()
        if op4_binary.byte_order(head):
            return op4_binary.read, True
        if lines[0].lower().startswith(matrix_market.MARK.decode().lower()):
            return matrix_market.read, False
        if harwell_boeing.is_header(lines):
            return harwell_boeing.read, False
        if op4_text.is_header(lines[0]):
            return op4_text.read, True
        if dmig.is_deck(head) or suffix in NASTRAN:
            return dmig.read, True
        if suffix in calculix.SUFFIXES:
            return calculix.read, False
        if suffix == ".mtx" or _looks_like_entries(lines):
            return abaqus.read, False
        raise Fault(
            "the format is not known: neither Abaqus, CalculiX, Nastran OP4 or DMIG,"
            " Harwell-Boeing nor Matrix Market"
        )


def _lines(head):
    return head[:4096].decode("latin-1").splitlines() or [""]


def _looks_like_entries(lines):
    for line in lines:
        if line.strip() and not line.startswith("**"):
            return re.match(r"\s*(-?\d+\s*,\s*){2,4}[-+.\d]|\*MATRIX", line, re.I) is not None
    return False


def read_rows(path):
    """Returns the keys of the rows by a file: .dof of CalculiX, the mapping file of Ansys, or a
    table of the columns row, node and component like rows.csv. Raises Fault."""
    path = Path(path)
    if path.suffix.lower() == ".dof":
        return calculix.read_dof(path)
    return harwell_boeing.read_mapping(path)


def rows_next_to(paths):
    """Returns the files of rows that belong to matrices by their names."""
    found = []
    for path in paths:
        suffix = ".dof" if path.suffix.lower() in calculix.SUFFIXES else ".mapping"
        other = path.with_suffix(suffix)
        if other.is_file() and other not in found:
            found.append(other)
    return found


def job_of(word):
    """Returns the files of a job of CalculiX by the name of the job or of one of its files, as role
    and path, or None."""
    path = Path(word)
    if path.suffix.lower() not in (*calculix.SUFFIXES, ".dof"):
        if path.is_file() or not Path(f"{word}.sti").is_file():
            return None
        path = Path(f"{word}.sti")
    return [(role, path.with_suffix(suffix)) for suffix, role in calculix.SUFFIXES.items()]
