# SPDX-License-Identifier: BSD-2-Clause
"""Parameters of Abaqus decks: *PARAMETER defines them, <name> stands for their values."""
import re

from squeal.deck.inp.expression import evaluate
from squeal.deck.inp.handlers import handles
from squeal.deck.journal import Fault, Source

CARD = re.compile(r"\*\s*PARAMETER\s*(,|$)", re.IGNORECASE)
NAME = re.compile(r"[A-Za-z]\w*")
REFERENCE = re.compile(r"<\s*([^<>]*?)\s*>")


def substitute(lines, journal):
    """Returns the lines of a deck with the values of its parameters. A name that has none remains,
    and its field is refused where it is read."""
    if not any(CARD.match(line.text) for line in lines if line.text.startswith("*")):
        return lines
    values, inside = {}, None
    for line in lines:
        if line.text.startswith("*"):
            inside = line if CARD.match(line.text) else None
        elif inside is not None:
            _define(line, inside, values, journal)
    found = []
    for line in lines:
        if line.text.startswith("*"):
            inside = line if CARD.match(line.text) else None
        if inside is None and "<" in line.text:
            line = line._replace(text=_with_values(line.text, values))
        found.append(line)
    return found


def _define(line, card, values, journal):
    """Reads assignments separated by semicolons; # begins a comment."""
    source = Source(card.file, card.number, "PARAMETER")
    journal.open(source)
    for part in filter(str.strip, line.text.split("#")[0].split(";")):
        name, equals, text = part.partition("=")
        name = name.strip()
        try:
            if not equals or not NAME.fullmatch(name):
                raise Fault(f"'{part.strip()}' is not an assignment, name = expression")
            same = next((one for one in values if one.upper() == name.upper()), None)
            if same is not None:
                raise Fault(f"the parameter {same} is defined twice")
            values[name] = evaluate(text, values)
            journal.remark(source, f"{name} is {values[name]!r}")
        except Fault as fault:
            if journal.refuse(source, fault.reason, line=line.number):
                values.setdefault(name, 1)  # one fault is enough


def _with_values(text, values):
    names = {name.upper(): name for name in values}

    def value(match):
        name = names.get(match[1].upper())
        return match[0] if name is None else repr(values[name])

    return REFERENCE.sub(value, text)


@handles("PARAMETER", phase=0)
def parameter(card, reader):
    """Its values are in the lines of the deck already."""
