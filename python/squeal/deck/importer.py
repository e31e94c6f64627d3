# SPDX-License-Identifier: BSD-2-Clause
"""Translates a deck into the folder of a case: mesh.msh, case.yaml and import.md."""
import argparse
from pathlib import Path

from squeal.deck.bdf import reader as bdf
from squeal.deck.case.faces import Faces
from squeal.deck.case.translate import translate
from squeal.deck.inp.dialect import DIALECTS
from squeal.deck.inp.reader import read_model
from squeal.deck.journal import DeckError, Journal
from squeal.deck.output.account import write_account
from squeal.deck.output.msh import write_mesh
from squeal.deck.output.options import MARK, write_options

NASTRAN = (".bdf", ".dat", ".nas")  # endings of decks of Nastran
PARTIAL = "mesh.msh.partial"  # the mesh gets its name when all is written
FILES = ("mesh.msh", "case.yaml", "import.md", PARTIAL)


def _read(deck, dialect, subcase, journal):
    """Returns the model of a deck."""
    if Path(deck).suffix.lower() in NASTRAN:
        return bdf.read_model(deck, journal, subcase)
    if subcase is not None:
        raise DeckError("--subcase is for decks of Nastran")
    return read_model(deck, DIALECTS.get(dialect), journal)


def import_deck(deck, folder, dialect=None, ignored=(), speed=None, subcase=None):
    """Writes the case of a deck into a folder, and returns its journal. `dialect` None: the one
    that is detected. `speed`: that of a motion of which the deck has only the direction. If the
    deck is refused, writes only import.md and raises DeckError."""
    folder = Path(folder)
    journal = Journal(ignored)
    model = _read(deck, dialect, subcase, journal)
    model.speed = speed
    case = translate(model, journal)
    _prepare(folder)
    try:
        accounted = None if journal.refusals else case
        write_account(folder / "import.md", model, accounted, journal)
        journal.require_translatable(str(deck))
        for name in journal.unmet():
            raise DeckError(f"--ignore {name}: {deck} has nothing of this name that is refused")
        write_mesh(folder / PARTIAL, model, case, Faces(model))
        write_options(folder / "case.yaml", case, model, ignored)
        (folder / PARTIAL).rename(folder / "mesh.msh")
    except OSError as error:
        raise DeckError(f"{error.filename or folder}: {error.strerror}") from None
    return journal


def _prepare(folder):
    """Makes the folder, and removes the files of an earlier import. Raises DeckError if a case is
    there that was not imported."""
    case = folder / "case.yaml"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if case.exists() and not case.read_text(encoding="utf-8", errors="replace").startswith(
            MARK
        ):
            raise DeckError(f"{case} was not made by squeal-import; choose another folder")
        if not case.exists() and (folder / "mesh.msh").exists():
            raise DeckError(f"{folder} has a mesh.msh of another origin; choose another folder")
        for name in FILES:
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise DeckError(f"{error.filename or folder}: {error.strerror}") from None


def main(words):
    parser = argparse.ArgumentParser(prog="squeal-import", description=__doc__)
    add = parser.add_argument
    add("deck", metavar="DECK", help="deck of Abaqus or CalculiX (.inp) or Nastran (.bdf)")
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
    given = parser.parse_args(words)
    if given.speed is not None and not 0 < given.speed < float("inf"):
        raise DeckError(f"--speed {given.speed:g}: the speed of a motion is positive")
    folder = Path(given.output or Path(given.deck).stem)
    words = (given.dialect, given.ignore, given.speed, given.subcase)
    journal = import_deck(given.deck, folder, *words)
    print(f"{folder / 'case.yaml'}: the case; {folder / 'import.md'}: the account of the deck")
    print(f"  cards: {journal.counted()}")
    for choice in journal.choices:
        print(f"  {choice}")
