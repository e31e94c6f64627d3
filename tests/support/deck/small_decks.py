# SPDX-License-Identifier: BSD-2-Clause
"""Small decks for tests, their import, and a reader of the meshes that it writes."""
import re
import struct
import tempfile
from pathlib import Path

import numpy as np
import yaml

from squeal.deck.importer import import_deck
from squeal.deck.inp.dialect import CALCULIX
from squeal.deck.inp.reader import read_model
from squeal.deck.journal import DeckError, Journal

CUBE = """*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=BOTTOM
1, 2, 3, 4
*NSET, NSET=TOP
5, 6, 7, 8
"""
STEEL = """*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*DENSITY
7.8E-9
*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL
"""
HELD = """*BOUNDARY
BOTTOM, 1, 3
"""
STATIC = """*STEP
*STATIC
{}*END STEP
"""


def cube(model="", step="", after=""):
    """Returns the deck of a cube of steel on a clamped face, with more cards before the step, in it
    and after it."""
    return CUBE + STEEL + HELD + model + STATIC.format(step) + after


class Imported:
    """The case of a deck: `text` and `options` of case.yaml, `groups` by name (node numbers, or
    rows of nodes of faces and cells), `nodes` and `coordinates`, and the journal."""

    def __init__(self, text, files=(), deck="deck.inp", **words):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / deck
            path.write_bytes(text if isinstance(text, bytes) else text.encode())
            for name, content in dict(files).items():
                (Path(folder) / name).parent.mkdir(parents=True, exist_ok=True)
                (Path(folder) / name).write_text(content)
            self.journal = import_deck(path, Path(folder) / "case", **words)
            self.text = (Path(folder) / "case/case.yaml").read_text()
            self.options = yaml.safe_load(self.text)
            self.account = (Path(folder) / "case/import.md").read_text()
            self.groups, self.nodes, self.coordinates = read_mesh(Path(folder) / "case/mesh.msh")

    def remarks(self, card):
        """Returns outcome and remarks of the first card with a keyword."""
        entry = next(one for key, one in self.journal.entries.items() if key.card == card)
        return entry.status, "; ".join(entry.remarks)


def refused(text, files=(), **words):
    """Returns the lines of the error with which a deck is refused, without the first."""
    try:
        Imported(text, files, **words)
    except DeckError as error:
        return [line.strip() for line in str(error).splitlines()[1:]]
    raise AssertionError("the deck is not refused")


def numbers(text):
    """Returns the numbers of a list of an option."""
    return [float(word) for word in str(text).split(",")]


def terms(equation):
    """Returns the coefficients of an equation by place."""
    left, right = equation.split(" = ")
    assert right == "0"
    found = {}
    for sign, factor, place in re.findall(r"(^|[+-] )(?:([\d.e+-]+)\*)?(\S+:\w+)", left):
        found[place] = (-1 if sign == "- " else 1) * float(factor or 1)
    return found


def model_of(text):
    """Returns model and journal of a deck, which may be incomplete."""
    journal = Journal()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "deck.inp"
        path.write_text(text)
        return read_model(path, CALCULIX, journal), journal


def read_mesh(path):
    """Returns the groups, node numbers and coordinates of a binary gmsh file 4.1."""
    data = path.read_bytes()
    sections = {}
    for name in (b"PhysicalNames", b"Entities", b"Nodes", b"Elements"):
        start = data.index(b"$" + name + b"\n") + len(name) + 2
        sections[name] = data[start : data.index(b"\n$End" + name)]
    names = {}
    for line in sections[b"PhysicalNames"].decode().splitlines()[1:]:
        dimension, number, name = line.split(" ", 2)
        names[int(dimension), int(number)] = name.strip('"')
    tags = _entities(sections[b"Entities"])
    block = sections[b"Nodes"]
    count = struct.unpack_from("<4Q", block)[1]
    at = 32 + struct.calcsize("<3iQ")
    numbers = np.frombuffer(block, "<u8", count, at).astype(int)
    coordinates = np.frombuffer(block, "<f8", 3 * count, at + 8 * count).reshape(-1, 3)
    return _groups(sections[b"Elements"], names, tags), numbers, coordinates


def _entities(block):
    """Returns the numbers of the groups of each entity by (dimension, number)."""
    counts, at, tags = struct.unpack_from("<4Q", block), 32, {}
    for dimension in range(4):
        for _ in range(counts[dimension]):
            (number,) = struct.unpack_from("<i", block, at)
            at += 4 + 8 * (3 if dimension == 0 else 6)
            (size,) = struct.unpack_from("<Q", block, at)
            tags[dimension, number] = struct.unpack_from(f"<{size}i", block, at + 8)
            at += 8 + 4 * size + (8 if dimension else 0)
    assert at == len(block)
    return tags


def _groups(block, names, tags):
    sizes = {4: 4, 5: 8, 6: 6, 11: 10, 17: 20, 18: 15, 2: 3, 3: 4, 9: 6, 16: 8, 15: 1}
    count, total, _, _ = struct.unpack_from("<4Q", block)
    at, groups, elements, seen = 32, {}, [], set()
    for _ in range(count):
        dimension, entity, kind, rows = struct.unpack_from("<3iQ", block, at)
        at += struct.calcsize("<3iQ")
        # gmsh loses cells of a second type in an entity.
        assert (dimension, entity) not in seen
        seen.add((dimension, entity))
        table = np.frombuffer(block, "<u8", rows * (1 + sizes[kind]), at).reshape(rows, -1)
        at += table.nbytes
        elements.extend(table[:, 0])
        for tag in tags[dimension, entity]:
            groups.setdefault(names[dimension, tag], []).extend(map(tuple, table[:, 1:].tolist()))
    assert at == len(block) and len(set(elements)) == len(elements) == total
    return {
        name: sorted(row[0] for row in rows) if len(rows[0]) == 1 else rows
        for name, rows in groups.items()
    }
