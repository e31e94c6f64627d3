# SPDX-License-Identifier: BSD-2-Clause
"""Translates a deck, or matrices of other programs, into the folder of a case."""
import argparse
from pathlib import Path

from squeal.deck.case.faces import Faces
from squeal.deck.case.translate import translate
from squeal.deck.inp.dialect import CALCULIX
from squeal.deck.inp.reader import read_model
from squeal.deck.journal import DeckError, Journal
from squeal.deck.output.account import write_account
from squeal.deck.output.folder import PARTIAL, prepare
from squeal.deck.output.msh import write_mesh
from squeal.deck.output.options import write_options
from squeal.matrices import importer as matrices

DIALECTS = {"calculix": CALCULIX}


def import_deck(deck, folder, dialect="calculix", ignored=()):
    """Writes the case of a deck into a folder, and returns its journal. If the deck is refused,
    writes only import.md and raises DeckError."""
    folder = Path(folder)
    journal = Journal(ignored)
    model = read_model(deck, DIALECTS[dialect], journal)
    case = translate(model, journal)
    prepare(folder)
    try:
        accounted = None if journal.refusals else case
        write_account(folder / "import.md", model, accounted, journal, DIALECTS[dialect])
        journal.require_translatable(str(deck))
        for name in journal.unmet():
            raise DeckError(f"--ignore {name}: {deck} has nothing of this name that is refused")
        write_mesh(folder / PARTIAL, model, case, Faces(model))
        write_options(folder / "case.yaml", case, model.title, DIALECTS[dialect], ignored)
        (folder / PARTIAL).rename(folder / "mesh.msh")
    except OSError as error:
        raise DeckError(f"{error.filename or folder}: {error.strerror}") from None
    return journal


def main(words):
    parser = argparse.ArgumentParser(prog="squeal-import", description=__doc__)
    add = parser.add_argument
    deck = "deck of CalculiX (.inp), or the name of a job with matrices (JOB.sti, .mas, .dof)"
    add("deck", metavar="DECK", nargs="?", help=deck)
    folder = "folder of the case; default: the name of the deck, in the working folder"
    add("-o", "--output", metavar="FOLDER", help=folder)
    add("--dialect", choices=sorted(DIALECTS), default="calculix", help="program of the deck")
    ignored = "card, parameter, load or type of element to leave out although it is physics"
    add("--ignore", metavar="NAME", action="append", default=[], help=ignored)
    matrices.add_options(parser)
    given = parser.parse_args(words)
    if files := matrices.files_of(given):
        return matrices.run(given, files, parser)
    if not given.deck or given.rows or given.whole or given.triangle:
        parser.error("a deck, or a stiffness and a mass matrix, is needed")
    folder = Path(given.output or Path(given.deck).stem)
    journal = import_deck(given.deck, folder, given.dialect, given.ignore)
    print(f"{folder / 'case.yaml'}: the case; {folder / 'import.md'}: the account of the deck")
    print(f"  cards: {journal.counted()}")
    for choice in journal.choices:
        print(f"  {choice}")
