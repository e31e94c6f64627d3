# SPDX-License-Identifier: BSD-2-Clause
"""Finds out for which program a deck is written, by words that only one of them has."""
from squeal.deck.inp.cards import key_of, keyword_of
from squeal.deck.inp.dialect import (
    ABAQUS,
    ABAQUS_PARAMETERS,
    CALCULIX,
    CALCULIX_PARAMETERS,
    ONLY_ABAQUS,
    ONLY_CALCULIX,
    UNDECIDED,
)
from squeal.deck.inp.state import SYMMETRIES
from squeal.deck.inp.types import ONLY_ABAQUS_TYPES

SHOWN = 3  # marks of each program that are listed


def detect(lines):
    """Returns the dialect of lines, and its reason as a text."""
    marks = {ABAQUS: [], CALCULIX: []}
    keyword = ""
    for line in lines:
        if line.text.startswith("*"):
            keyword, found = _marks_of_card(line.text)
        elif keyword == "BOUNDARY":
            fields = line.text.split(",")
            word = key_of(fields[1]) if len(fields) > 1 else ""
            found = [(ABAQUS, word)] if word in SYMMETRIES else []
        else:
            continue
        for dialect, mark in found:
            marks[dialect].append((mark, f"{line.file}:{line.number}"))
    return _decide(marks)


def _marks_of_card(text):
    keyword, *words = text[1:].split(",")
    keyword, found = keyword_of(keyword)[0], []
    if keyword in ONLY_ABAQUS:
        found.append((ABAQUS, f"*{keyword}"))
    if keyword in ONLY_CALCULIX:
        found.append((CALCULIX, f"*{keyword}"))
    if keyword == "CONTACT PAIR" and not any(key_of(word).startswith("TYPE=") for word in words):
        found.append((ABAQUS, "*CONTACT PAIR without TYPE="))
    for word in words:
        name, _, value = word.partition("=")
        name, value = key_of(name), key_of(value)
        for dialect, table in ((ABAQUS, ABAQUS_PARAMETERS), (CALCULIX, CALCULIX_PARAMETERS)):
            for card, parameter, values in table:
                if card == keyword and parameter.replace(" ", "") == name:
                    if values is None or value in values:
                        found.append((dialect, f"*{keyword}, {word.strip()}"))
        if keyword == "ELEMENT" and name == "TYPE" and value in ONLY_ABAQUS_TYPES:
            found.append((ABAQUS, f"*{keyword}, {word.strip()}"))
    return keyword, found


def _decide(marks):
    reasons = {}
    for dialect, found in marks.items():
        first = {}
        for mark, place in found:
            if mark not in first.values():
                first.setdefault(place, mark)
        shown = [f"{mark} ({place})" for place, mark in list(first.items())[:SHOWN]]
        if shown:
            reasons[dialect] = ", ".join(shown)
    if len(reasons) == 1:
        ((dialect, reason),) = reasons.items()
        return dialect, f"for {reason}"
    if not reasons:
        return UNDECIDED, "since no word of the deck belongs to only one of them"
    both = "; ".join(f"{dialect.name} has {reason}" for dialect, reason in reasons.items())
    return UNDECIDED, f"since {both}"
