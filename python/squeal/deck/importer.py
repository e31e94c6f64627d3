# SPDX-License-Identifier: BSD-2-Clause
"""Translates a deck, or matrices of other programs, into the folder of a case."""
import argparse
import contextlib
import gc
import os
import time
from pathlib import Path

from squeal.deck.bdf import reader as bdf
from squeal.deck.case.faces import Faces
from squeal.deck.case.translate import translate
from squeal.deck.inp.dialect import DIALECTS
from squeal.deck.inp.reader import read_model
from squeal.deck.journal import DeckError, Journal
from squeal.deck.output.account import write_account
from squeal.deck.output.folder import PARTIAL, prepare
from squeal.deck.output.msh import write_mesh
from squeal.deck.output.options import write_options
from squeal.matrices import importer as matrices

NASTRAN = (".bdf", ".dat", ".nas")  # endings of decks of Nastran


@contextlib.contextmanager
def _without_collections():
    """Stops the search for cycles of objects: among millions of lines it takes seconds, and there
    are none."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


@_without_collections()
def _read(deck, dialect, subcase, journal):
    """Returns the model of a deck."""
    if Path(deck).suffix.lower() in NASTRAN:
        return bdf.read_model(deck, journal, subcase)
    if subcase is not None:
        raise DeckError("--subcase is for decks of Nastran")
    return read_model(deck, DIALECTS.get(dialect), journal)


def import_deck(deck, folder, dialect=None, ignored=(), speed=None, **more):
    """Writes the case of a deck into a folder, and returns its journal. `dialect` None: the one
    that is detected. `speed`: that of a motion of which the deck has only the direction.
    `more`: `progress` is called with a text before each stage; `subcase` is that of a deck of
    Nastran. If the deck is refused, writes only import.md and raises DeckError."""
    folder = Path(folder)
    journal = Journal(ignored)
    progress = more.get("progress", lambda text: None)
    progress(f"{deck}: reading")
    model = _read(deck, dialect, more.get("subcase"), journal)
    model.speed = speed
    cells = sum(len(block.numbers) for block in model.blocks)
    progress(f"{deck}: translating {len(model.nodes.numbers)} nodes and {cells} elements")
    case = translate(model, journal)
    prepare(folder)
    try:
        accounted = None if journal.refusals else case
        write_account(folder / "import.md", model, accounted, journal)
        journal.require_translatable(str(deck))
        for name in journal.unmet():
            raise DeckError(f"--ignore {name}: {deck} has nothing of this name that is refused")
        progress(f"{folder}: writing")
        write_mesh(folder / PARTIAL, model, case, Faces(model))
        write_options(folder / "case.yaml", case, model, ignored)
        (folder / PARTIAL).rename(folder / "mesh.msh")
    except OSError as error:
        raise DeckError(f"{error.filename or folder}: {error.strerror}") from None
    return journal


class Progress:
    """Lines for a person who waits for a large deck, with the seconds since the start."""

    SMALL = 10e6  # bytes of a deck that is read at once

    def __init__(self, deck):
        self.started = time.monotonic()
        self.large = os.path.isfile(deck) and os.path.getsize(deck) > self.SMALL

    def show(self, text):
        if self.large:
            print(f"{time.monotonic() - self.started:6.1f} s  {text}", flush=True)


def main(words):
    pages = "docs/decks.md lists the cards, docs/matrices_import.md the formats of matrices."
    parser = argparse.ArgumentParser(prog="squeal-import", description=__doc__, epilog=pages)
    add = parser.add_argument
    deck = (
        "deck of Abaqus or CalculiX (.inp) or Nastran (.bdf, .dat, .nas), or the name of a job of"
        " CalculiX that stored matrices (JOB.sti, JOB.mas, JOB.dof)"
    )
    add("deck", metavar="DECK", nargs="?", help=deck)
    folder = "folder of the case; default: the name of the deck, in the working folder"
    add("-o", "--output", metavar="FOLDER", help=folder)
    dialect = "program of the deck; default: the one whose words the deck has"
    add("--dialect", choices=sorted(DIALECTS), help=dialect)
    ignored = "card, parameter, load or type of element to leave out although it is physics"
    speed = (
        "speed of a body of whose motion the deck has only the direction, in rad or length per time"
        " unit of the deck"
    )
    add("--ignore", metavar="NAME", action="append", default=[], help=ignored)
    add("--speed", metavar="V", type=float, help=speed)
    number = "subcase of a deck of Nastran; default: the first one that fits the solution"
    add("--subcase", metavar="NUMBER", type=int, help=number)
    matrices.add_options(parser)
    given = parser.parse_args(words)
    if files := matrices.files_of(given):
        return matrices.run(given, files, parser)
    if not given.deck or given.rows or given.whole or given.triangle:
        parser.error("a deck, or a stiffness and a mass matrix, is needed")
    if given.speed is not None and not 0 < given.speed < float("inf"):
        raise DeckError(f"--speed {given.speed:g}: the speed of a motion is positive")
    folder = Path(given.output or Path(given.deck).stem)
    more = {"progress": Progress(given.deck).show, "subcase": given.subcase}
    journal = import_deck(given.deck, folder, given.dialect, given.ignore, given.speed, **more)
    print(f"{folder / 'case.yaml'}: the case; {folder / 'import.md'}: the account of the deck")
    print(f"  cards: {journal.counted()}")
    for choice in journal.choices:
        print(f"  {choice}")
