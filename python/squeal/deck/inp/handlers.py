# SPDX-License-Identifier: BSD-2-Clause
"""The table of cards that are understood, with the parameters of each."""
from dataclasses import dataclass

from squeal.deck.journal import Fault

TABLE = {}
PARAMETERS = {
    "AMPLITUDE": "amplitudes are not supported",
    "USER": "user routines are not supported",
    "SUBMODEL": "submodels are not supported",
    "FIXED": "values that earlier steps have reached are not supported",
    "COMPOSITE": "layered sections are not supported",
    "NONLINEAR": "nonlinear springs are not supported",
    "INPUT": "lines of other files are not supported; use *INCLUDE below the card",
}


@dataclass(frozen=True)
class Handler:
    """`used`: parameters that the function reads; `idle`: parameters without effect on the model,
    None for any. `phase`: 0 for nodes, elements and sets, 1 for surfaces, 2 for all others; a phase
    is read when the one before has ended, so that a name may be used before its definition.
    `lines`: largest number of lines of data."""

    function: object
    used: tuple
    idle: tuple
    phase: int
    lines: int


def handles(*keywords, used=(), idle=(), phase=2, lines=None):
    """Registers a function of a card and the reader as the one that honours cards."""

    def register(function):
        for keyword in keywords:
            TABLE[keyword] = Handler(function, used, idle, phase, lines)
        return function

    return register


def settle(card, handler, journal):
    """Gives parameters that are written without blanks, or shortened, their full names; refuses
    those that the handler does not know. Raises Fault for a parameter that is given twice, and for
    too many lines of data."""
    if handler.lines is not None and len(card.data) > handler.lines:
        line = card.data[handler.lines][0]
        raise Fault(f"this card has at most {handler.lines} lines of data", line=line)
    if handler.idle is None:
        return
    known = {name.replace(" ", ""): name for name in (*handler.used, *handler.idle)}
    settled = {}
    for written, value in card.parameters.items():
        key = written.replace(" ", "")
        longer = [name for short, name in known.items() if short.startswith(key)]
        if key in known:
            name = known[key]
        elif len(key) >= 3 and len(longer) == 1:
            name = longer[0]
            if not card.dialect.short_words:
                journal.choose(
                    f"{card.source}: {written} is read as {name};"
                    " CalculiX does not know short words"
                )
        else:
            reason = PARAMETERS.get(written, "this parameter is not supported")
            journal.refuse(card.source, reason, written)
            continue
        if name in settled:
            raise Fault(f"{name} is given twice")
        settled[name] = value
        if name in handler.idle:
            journal.remark(card.source, f"{written} is not used")
    card.parameters = settled
