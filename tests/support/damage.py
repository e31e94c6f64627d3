# SPDX-License-Identifier: BSD-2-Clause
"""Damage to input files, for tests that nothing is lost without a word."""
import re
import tempfile
import time
from pathlib import Path

from squeal.deck.importer import import_deck
from squeal.deck.journal import DeckError

SLOW = 10  # s for one deck


def damaged(text, rng, times, words, letters, separators=None, inserted=""):
    """Returns a text with one of `times` changes: a line removed, doubled, inserted or cut short, a
    word in place of another, a letter in place of another or, of `inserted`, between two. Words
    are parted by commas, or by a pattern with a group, whose matches may be replaced as well."""
    lines = text.split("\n")
    for _ in range(rng.choice(times)):
        at = rng.randrange(len(lines))
        kind = rng.randrange(7 if inserted else 6)
        if kind == 0 and len(lines) > 1:
            del lines[at]
        elif kind == 1:
            lines.insert(at, rng.choice(lines))
        elif kind == 2:
            parts = re.split(separators, lines[at]) if separators else lines[at].split(",")
            parts[rng.randrange(len(parts))] = rng.choice(words)
            lines[at] = ("" if separators else ",").join(parts)
        elif kind == 3:
            lines.insert(at, rng.choice(words))
        elif kind in (4, 5) and lines[at] and (kind == 4 or inserted):
            place = rng.randrange(len(lines[at]))
            letter = rng.choice(letters if kind == 4 else inserted)
            lines[at] = lines[at][:place] + letter + lines[at][place + (kind == 4) :]
        else:
            lines[at] = lines[at][: rng.randrange(len(lines[at]) + 1)]
    return "\n".join(lines)


def translated(test, name, texts, complete):
    """Imports each of the texts as a deck of this name. Each is translated, and then
    `complete`(text, journal, folder of the case) is called, or refused in words, soon. Returns the
    number of translated ones. `test`: the unittest.TestCase that makes the assertions."""
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        deck, case = Path(folder) / name, Path(folder) / "case"
        for number, text in enumerate(texts):
            deck.write_text(text, encoding="utf-8")
            started = time.monotonic()
            with test.subTest(number=number, text=text):
                try:
                    journal = import_deck(deck, case)
                except DeckError as error:
                    test.assertGreater(len(str(error)), 20)
                else:
                    count += 1
                    complete(text, journal, case)
                test.assertLess(time.monotonic() - started, SLOW)
    return count
