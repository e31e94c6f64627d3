#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Damaged files of matrices: each is imported or refused in words, and what is imported has the
entries of the file.

Entries are counted and summed by readers of this test, which take one number after another. With
SQUEAL_LONG in the environment, 10,000 files in place of 400.
"""
import math
import os
import random
import re
import struct
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
folders = ("python", "tests/support/matrices", "tests/support")
sys.path[:0] = [str(repository / one) for one in folders]
sys.dont_write_bytecode = True
import matrix_files as files
from damage import damaged

from squeal.deck.journal import DeckError
from squeal.matrices.importer import import_matrices

COUNT = 10000 if os.environ.get("SQUEAL_LONG") else 400
SIZE = 6
WORDS = (
    *("", "0", "-1", "1e400", "nan", "99999999999999999999", "1.5", "*", "**", "$", ",", ",,"),
    *("1.D3", "2.-1", "inf", "%", "\t", "\0", "é", "DMIG", "DMIG*", "+", "*MATRIX INPUT", "-5"),
)

# Beginnings of files of each format, and what may follow in any of them.
HEADS = (
    *(b"", b"t\nt\nRSA", b"1,1, 1,1, 2.\n", b"*MATRIX INPUT\n", b"DMIG    K       "),
    *(b"%%MatrixMarket matrix coordinate real general\n", struct.pack("<i", 24)),
    *(b"       3       3       6       2KAA     1P,3E23.16\n", struct.pack(">i", 48)),
)
TOKENS = (
    *(b"1", b"2", b" ", b",", b"\n", b"-1", b"1.5", b"E+05", b"*", b"\0", b"\xff", b"\t", b"\r\n"),
    *(b"        ", b"       1       1       3\n", b"2147483647", b"*       ", b" 1.000E+00"),
    *(b"DMIG*   K               ", struct.pack("<i", 12), struct.pack("<i", 2**31 - 1)),
)


def seed_matrix():
    stiffness, _, _ = files.chain(SIZE)
    stiffness += np.diag(np.arange(SIZE) * 0.25)
    stiffness[0, 4] = stiffness[4, 0] = -3.5
    return stiffness


def seeds():
    """Returns for each format its content, its file and the name of the matrix."""
    matrix = seed_matrix()
    two = {"KAA": matrix, "MAA": np.eye(SIZE)}
    found = {
        "abaqus": (files.abaqus(matrix), "k.mtx", ""),
        "abaqus_all": (files.abaqus(matrix, "all", header="** comment"), "k.mtx", ""),
        "coordinates": (files.coordinates(matrix), "k.mtx", ""),
        "calculix": (files.calculix(matrix), "k.sti", ""),
        "matrix_market": (files.matrix_market(matrix), "k", ""),
        "hb": (files.harwell_boeing(matrix, sides=1), "k", ""),
        "hb_wide": (files.harwell_boeing(matrix, "RUA", per_line=3), "k", ""),
        "dmig_large": (files.dmig(two), "k", ":KAA"),
        "dmig_small": (files.dmig({"KAA": matrix}, "small"), "k", ":KAA"),
        "dmig_free": (files.dmig({"KAA": matrix}, "free", 1), "k", ":KAA"),
    }
    for layout in ("dense", "sparse", "bigmat"):
        found[f"op4_text_{layout}"] = (files.op4_text(two, layout), "k", ":KAA")
        for order, word in (("<", 4), (">", 8)):
            data = files.op4_binary(two, layout, order, word)
            found[f"op4_{layout}_{word}"] = (data, "k", ":KAA")
    return found


def damaged_text(text, rng):
    letters, times = "0123456789.,-*+= eEdD$\tAZ", [1, 1, 1, 2, 4]
    return damaged(text, rng, times, WORDS, letters, r"([ ,]+)").encode()


def damaged_bytes(data, rng):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 3])):
        kind, at = rng.randrange(5), rng.randrange(len(data))
        if kind == 0:
            data[at] = rng.randrange(256)
        elif kind == 1:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 2:
            del data[at:]
        elif kind == 3:
            del data[at : at + rng.choice([1, 4, 8, 24])]
        else:
            data[at:at] = data[at : at + rng.choice([1, 4, 8, 24])]
        if not data:
            break
    return bytes(data)


def number(word):
    """Returns the number of a word of Fortran."""
    word = word.strip().upper().replace("D", "E")
    return float(re.sub(r"(?<=[0-9.])([+-])", r"E\1", word))


def values_of(kind, text):
    """Returns the values of a text whose layout the import has found valid."""
    lines = [line for line in text.split("\n") if line.strip()]
    if kind.startswith(("abaqus", "coordinates")):
        return [number(line.split(",")[-1]) for line in lines if not line.strip().startswith("*")]
    if kind == "calculix":
        return [number(line.split()[-1]) for line in lines]
    if kind == "matrix_market":
        return [number(line.split()[-1]) for line in lines if "%" not in line][1:]
    if kind.startswith("hb"):
        return _harwell_boeing(text.split("\n"))
    if kind.startswith("dmig"):
        return _dmig(lines)
    return _op4(text.split("\n"))


def _harwell_boeing(lines):
    cards = [int(lines[1][at : at + 14]) for at in range(14, 56, 14)]
    first = (5 if int(lines[1][56:70].strip() or 0) else 4) + cards[0] + cards[1]
    texts = [line for line in lines[first : first + cards[2]]]
    return [number(one[at : at + 24]) for one in texts for at in range(0, len(one.rstrip()), 24)]


def _dmig(lines):
    """Takes the fields of the cards of KAA: each fourth one after the fifth."""
    cards = []
    for line in lines:
        line = line.expandtabs(8)
        if line.startswith("$"):
            continue
        starred = "*" in line[:8] if "," not in line else line.split(",")[0].strip().endswith("*")
        width, most = (16, 4) if starred else (8, 8)
        if "," in line:
            fields = (line.split(",") + [""] * 9)[: 1 + most]
        else:
            fields = [line[:8]] + [line[at : at + width] for at in range(8, 72, width)]
        if line[0] in " +*,":
            cards[-1] += fields[1:]
        else:
            cards.append(fields)
    found = []
    for card in cards:
        mine = card[0].strip().rstrip("*").upper() == "DMIG" and card[1].strip().upper() == "KAA"
        if mine and int(card[2]):
            found += [number(one) for one in card[7::4] if one.strip()]
    return found


def _op4(lines):
    """Takes all numbers of the first matrix with a point that are not of the last record."""
    rest = iter(lines)
    header = next(line for line in rest if line.strip())
    size, found = int(header[:8]), []
    while header[32:40].strip().upper() != "KAA":  # the matrix is the second one
        header = next(line for line in rest if "1P," in line)
        size = int(header[:8])
    for line in rest:
        if "." not in line and len(line) > 16 and int(line[:8]) > size:
            return found
        if "." in line:
            found += [number(line[at : at + 24]) for at in range(0, len(line.rstrip()), 24)]
    raise AssertionError("the matrix has no end")


def _op4_binary(data, order, word):
    """Reads the matrix KAA of a valid file, record by record."""
    integer, at, found = ("i" if word == 4 else "q"), 0, []
    size = None
    while at < len(data):
        (length,) = struct.unpack_from(order + "i", data, at)
        record = data[at + 4 : at + 4 + length]
        at += 8 + length
        if size is None:  # a header
            size, rows, _, kind = struct.unpack_from(f"{order}4{integer}", record)
            mine = b"KAA" == record[4 * word :].replace(b"\0", b"").replace(b" ", b"").upper()
            continue
        column, first, _ = struct.unpack_from(f"{order}3{integer}", record)
        if column > size:
            size = None
        elif mine:
            real = "f" if kind == 1 and word == 4 else "d"
            head = 0 if first > 0 else 2 if rows < 0 or rows > 65535 else 1
            found += _op4_values(record[3 * word :], order, word, (head, real))
    return found


def _op4_values(body, order, word, layout):
    (head, real), integer, found = layout, ("i" if word == 4 else "q"), []
    while body:
        numbers = struct.unpack_from(f"{order}{head}{integer}", body)
        words = len(body) // word
        if head:
            words = numbers[0] - 1 if head == 2 else numbers[0] // 65536 - 1
        body = body[head * word :]
        count = words * word // struct.calcsize(order + real)
        found += struct.unpack_from(f"{order}{count}{real}", body)
        body = body[words * word :]
    return found


def component(word):
    """Returns the component of a label as rows.csv has it."""
    labels = ("UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ")
    word = word.upper()
    return (
        str(labels.index(word) + 1)
        if word in labels
        else str(int(word))
        if word.isdigit()
        else word
    )


class Damaged(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_no_entry_is_lost_without_a_word(self):
        rng = random.Random(38)
        all_seeds, imported = seeds(), {}
        for count in range(COUNT):
            kind = list(all_seeds)[count % len(all_seeds)]
            content, name, chosen = all_seeds[kind]
            damage = damaged_bytes if isinstance(content, bytes) else damaged_text
            data = damage(content, rng)
            path = self.folder / name
            path.write_bytes(data)
            started = time.monotonic()
            with self.subTest(count=count, kind=kind, data=data):
                try:
                    roles = [("stiffness", f"{path}{chosen}"), ("mass", f"{path}{chosen}")]
                    record = import_matrices(roles, self.folder / "case")
                except DeckError as error:
                    self.assertGreater(len(str(error)), 20)
                    self.assertIn(name, str(error))
                else:
                    imported[kind] = imported.get(kind, 0) + 1
                    self.complete(kind, data, record)
                self.assertLess(time.monotonic() - started, 10)
        # Enough of them must be imported for the test to mean something.
        self.assertGreater(sum(imported.values()), COUNT // 20)

    def complete(self, kind, data, record):
        """Compares the account with entries that are read independently."""
        account = (self.folder / "case/import.md").read_text()
        row = next(one for one in account.splitlines() if one.startswith("| stiffness |"))
        cells = [cell.strip() for cell in row.split("|")]
        read, zeros, duplicates, written, total = map(float, cells[5:10])
        matrix, count = files.petsc(self.folder / "case/stiffness.petsc")
        self.assertEqual(count, written)
        scale = 1e-12 * (np.sum(np.abs(matrix)) + 1e-300)
        self.assertAlmostEqual(np.sum(matrix), total, delta=scale)
        if isinstance(data, bytes) and re.fullmatch(r"op4_\w+_[48]", kind):
            word = int(kind[-1])
            values = _op4_binary(data, "<" if word == 4 else ">", word)
        else:
            values = values_of(kind, data.decode("latin-1"))
        self.assertEqual(len(values), read)
        self.assertEqual(sum(value == 0 for value in values), zeros)
        if "diagonal 1e36" in "".join(record.choices) or "no entry but" in "".join(record.choices):
            return
        if "expanded" in cells[4]:
            total = (np.sum(matrix) + np.trace(matrix)) / 2
        largest = max(map(abs, values), default=0)
        self.assertAlmostEqual(math.fsum(values), total, delta=1e-9 * largest)

    def test_random_words_are_refused_in_words(self):
        rng = random.Random(6)
        for count in range(COUNT):
            path = self.folder / rng.choice(("k", "k.mtx", "k.sti", "k.pch", "k.op4"))
            words = [rng.choice(HEADS)]
            words += [rng.choice(TOKENS) for _ in range(rng.randrange(100))]
            if rng.random() < 0.2:
                words.append(bytes(rng.randrange(256) for _ in range(rng.randrange(300))))
            path.write_bytes(b"".join(words) + rng.choice((b"", b"\n")))
            with self.subTest(count=count, data=path.read_bytes()):
                try:
                    import_matrices([("stiffness", path), ("mass", path)], self.folder / "case")
                except DeckError as error:
                    self.assertIn(path.name, str(error))

    def test_no_name_of_a_row_is_lost(self):
        rng = random.Random(5)
        matrix = self.folder / "k"
        matrix.write_text(files.matrix_market(seed_matrix()))
        roles, imported = [("stiffness", matrix), ("mass", matrix)], 0
        seeds_of_rows = {"k.dof": files.dof, "k.mapping": files.mapping}
        for count in range(COUNT // 10):
            name = list(seeds_of_rows)[count % 2]
            data = damaged_text(seeds_of_rows[name](files.names(SIZE)), rng)
            path = self.folder / name
            path.write_bytes(data)
            with self.subTest(count=count, data=data):
                try:
                    import_matrices(roles, self.folder / "case", path)
                except DeckError as error:
                    self.assertIn(name, str(error))
                    continue
                imported += 1
                lines = data.decode("latin-1").split("\n")
                if name == "k.dof":
                    wanted = [
                        tuple(str(int(part)) for part in one.split(".")) for one in lines if one
                    ]
                else:
                    words = [one.replace(",", " ").split() for one in lines]
                    words = [one for one in words if len(one) == 3 and one[0].isdigit()]
                    wanted = [(str(int(one[1])), component(one[2])) for one in words]
                rows = (self.folder / "case/rows.csv").read_text().splitlines()[1:]
                found = [tuple(one.split(","))[1:] for one in rows]
                self.assertEqual(found, wanted)
        self.assertGreater(imported, 0)


if __name__ == "__main__":
    unittest.main()
