# SPDX-License-Identifier: BSD-2-Clause
"""Amplitudes: factors of loads and displacements over time. Of a static step only the value at its
end counts, if the amplitude does not fall before."""
from dataclasses import dataclass

import numpy as np

from squeal.deck.inp.handlers import handles
from squeal.deck.journal import TRANSLATED, Fault, Source
from squeal.deck.numbers import real


@dataclass
class Amplitude:
    """A table of values over `times`, of the step or, if `total`, of all steps. `fault`: why loads
    cannot refer to it."""

    source: Source
    total: bool = False
    times: np.ndarray = None
    values: np.ndarray = None
    fault: Fault = None


@dataclass
class Clock:
    """The times of the static steps: `start` and `end` of the step that is read."""

    start: float = 0.0
    end: float = 0.0

    def begin(self, procedure):
        """The second number of *STATIC is the period of the step, 1 by default."""
        self.start = self.end
        for line, fields in procedure.rows():
            period = real(fields[1], line) if len(fields) > 1 and fields[1] else 0.0
            self.end += period or 1.0
            return
        self.end += 1.0


@handles("AMPLITUDE", used=("NAME", "TIME", "VALUE", "DEFINITION"), idle=None, phase=1)
def amplitude(card, reader):
    """Refused only if a load refers to it."""
    key, name = reader.defined(card, "NAME")
    if key in reader.model.amplitudes:
        raise Fault(f"the amplitude '{name}' is defined twice")
    one = reader.model.amplitudes[key] = Amplitude(card.source)
    try:
        _read(card, one)
    except Fault as fault:
        one.fault = fault


def _read(card, one):
    others = set(card.parameters) - {"NAME", "TIME", "VALUE", "DEFINITION"}
    if others:
        raise Fault(f"the parameter {min(others)} of the amplitude is not supported")
    for name, wanted in (("DEFINITION", "TABULAR"), ("VALUE", "RELATIVE")):
        if card.key(name, wanted) != wanted:
            raise Fault(f"an amplitude with {name}={card.value(name)} is not supported")
    kind = card.key("TIME", "STEPTIME")
    if kind not in ("STEPTIME", "TOTALTIME"):
        raise Fault(f"an amplitude with TIME={card.value('TIME')} is not supported")
    one.total = kind == "TOTALTIME"
    numbers = [real(word, line) if word else 0.0 for line, row in card.rows() for word in row]
    if not numbers or len(numbers) % 2:
        raise Fault("the lines of an amplitude have pairs of time and value")
    one.times, one.values = np.array(numbers).reshape(-1, 2).T
    if np.any(np.diff(one.times) <= 0):
        raise Fault("the times of an amplitude must increase")


def factor_of(card, reader):
    """Returns the factor of the values of a card: that of its amplitude at the end of the step, 1
    without one, or if it is refused."""
    if "AMPLITUDE" not in card.parameters:
        return 1.0
    try:
        value = _at_end(card, reader)
    except Fault as fault:
        reader.journal.refuse(card.source, fault.reason, "AMPLITUDE")
        return 1.0
    reader.journal.choose(
        f"{card.source}: the values of this card are multiplied by {value:g}, the value of"
        f" {card.value('AMPLITUDE')} at the end of the step"
    )
    return value


def _at_end(card, reader):
    name = card.require("AMPLITUDE")
    table = reader.model.amplitudes
    one = table.get(reader.key(card, "AMPLITUDE", table))
    if one is None:
        raise Fault(f"there is no amplitude '{name}'")
    if one.fault is not None:
        raise Fault(f"{one.source}: {one.fault.reason}")
    if not reader.step.timed:
        raise Fault("amplitudes outside static steps are not supported")
    end = reader.clock.end
    if not one.total:
        end -= reader.clock.start
    elif one.times[-1] > end:
        raise Fault("an amplitude that goes on after the step is not supported")
    before = one.values[one.times <= end]
    value = float(np.interp(end, one.times, one.values))
    path = np.abs([*before, value])
    if np.any(np.diff(path) < 0) or np.any(np.multiply(before, value) < 0):
        raise Fault("an amplitude that falls within the step is not supported")
    reader.journal.mark(one.source, TRANSLATED)
    return value
