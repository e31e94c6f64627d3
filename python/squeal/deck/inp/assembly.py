# SPDX-License-Identifier: BSD-2-Clause
"""Parts and their instances: each instance has names and numbers of its own.

The cards of a part are read once for each instance. In the model a set or surface of an instance
has the name `instance.name`, and its numbers are shifted by an offset; the assembly and the model
itself follow with their own numbers.
"""
from dataclasses import dataclass, field

import numpy as np

from squeal.deck.axes import rotation_about
from squeal.deck.inp.cards import key_of
from squeal.deck.inp.handlers import Handler, settle
from squeal.deck.journal import UNUSED, USED, Fault
from squeal.deck.mesh import Nodes
from squeal.deck.numbers import real

ENDS = {"END PART": "PART", "END INSTANCE": "INSTANCE", "END ASSEMBLY": "ASSEMBLY"}
WORDS = {
    "PART": Handler(None, ("NAME",), (), 0, 0),
    "ASSEMBLY": Handler(None, ("NAME",), (), 0, 0),
    "INSTANCE": Handler(None, ("NAME", "PART"), (), 0, 2),
}
# Cards that belong to the model. In a part they would be read once for each instance.
OF_MODEL = {
    *("MATERIAL", "ELASTIC", "DENSITY", "DAMPING", "SURFACE INTERACTION", "SURFACE BEHAVIOR"),
    *("FRICTION", "CONTACT PAIR", "BOUNDARY", "CLOAD", "DLOAD", "DSLOAD", "STEP", "END STEP"),
    "INITIAL CONDITIONS",
}


@dataclass(eq=False)
class Numbers:
    """Numbers of nodes or elements (`what`) of a scope. The model has them plus `offset`, so that
    those of scopes do not meet: `top` is the largest one that the scope has named, and when it is
    `closed`, larger ones do not exist."""

    what: str
    owner: str = ""
    offset: int = 0
    top: int = 0
    closed: bool = False

    def shifted(self, numbers, line=None):
        """Returns the numbers of the model of an array. Raises Fault for those outside."""
        if not len(numbers):
            return numbers
        low, high = int(np.min(numbers)), int(np.max(numbers))
        if self.offset and low < 1 or self.owner and low < 1:
            raise Fault(f"{self.what} {low}: numbers are 1 or more", line=line)
        if self.closed and high > self.top:
            raise Fault(f"there is no {self.what} {high} of {self.owner}", line=line)
        self.top = max(self.top, high)
        return numbers + self.offset

    def one(self, number, line=None):
        return int(self.shifted(np.array([number], np.int64), line)[0])

    def close(self, largest):
        """`largest`: the largest number of the model that the scope has made."""
        self.top = max(self.top, largest - self.offset)
        self.closed = bool(self.owner)

    def made(self, numbers, line=None):
        """Returns numbers of the model that the scope makes. Raises Fault for those below it."""
        if len(numbers) and int(np.min(numbers)) <= self.offset:
            low = int(np.min(numbers)) - self.offset
            raise Fault(f"{self.what} {low}: numbers are 1 or more", line=line)
        return numbers


@dataclass(eq=False)
class Scope:
    """An instance, or the model with its assembly (without a name). `nodes` have their final
    numbers, and coordinates in the axes of the part."""

    name: str = ""
    prefix: str = ""
    cards: list = field(default_factory=list)
    nodes: Nodes = field(default_factory=Nodes)
    node_numbers: Numbers = field(default_factory=lambda: Numbers("node"))
    element_numbers: Numbers = field(default_factory=lambda: Numbers("element"))
    translation: np.ndarray = field(default_factory=lambda: np.zeros(3))
    rotation: np.ndarray = field(default_factory=lambda: np.eye(3))
    system: object = None  # origin and axes of *SYSTEM

    def open(self, before):
        """Numbers begin above those of the scopes before."""
        for own, others in (
            (self.node_numbers, [one.node_numbers for one in before]),
            (self.element_numbers, [one.element_numbers for one in before]),
        ):
            own.owner = self.name
            own.offset = _above(max((one.offset + one.top for one in others), default=0))

    @property
    def turned(self):
        return not np.allclose(self.rotation, np.eye(3), 0, 1e-15)

    def placed(self, places):
        """Returns where points of the part are in the assembly."""
        return places @ self.rotation.T + self.translation


class Structure:
    """Distributes cards over scopes: `instances` in the order of the deck, and `model`."""

    def __init__(self, cards, journal):
        self.journal = journal
        self.parts, self.instances, self.model = {}, [], Scope()
        self.assembly = None
        self._open, self._target = [], self.model.cards
        for card in cards:
            self._place(card)
        for card in self._open:
            journal.refuse(card.source, f"no *END {card.keyword} follows")
        self._name_idle_parts()

    def _place(self, card):
        if card.keyword not in WORDS and card.keyword not in ENDS:
            if self._target is not self.model.cards and card.keyword in OF_MODEL:
                self.journal.refuse(card.source, "this card belongs to the model, not to a part")
            else:
                self._target.append(card)
            return
        try:
            if card.keyword in ENDS:
                self._end(card)
            else:
                settle(card, WORDS[card.keyword], self.journal)
                self._begin(card)
        except Fault as fault:
            self.journal.refuse(card.source, fault.reason, fault.name, fault.line)
        else:
            self.journal.mark(card.source, USED)

    def _begin(self, card):
        within = [one.keyword for one in self._open]
        wanted = ["ASSEMBLY"] if card.keyword == "INSTANCE" else []
        self._open.append(card)
        if within != wanted:
            where = f"within *{within[-1]}" if within else "outside of *ASSEMBLY"
            raise Fault(f"this card is {where}")
        if card.keyword == "PART":
            self._part(card)
        elif card.keyword == "INSTANCE":
            self._instance(card)
        elif self.assembly is not None:
            raise Fault("the deck has two assemblies")
        else:
            self.assembly = card.key("NAME", "ASSEMBLY")

    def _part(self, card):
        key = card.key("NAME")
        self._target = []
        if key in self.parts:
            raise Fault(f"the part '{card.value('NAME')}' is defined twice")
        self.parts[key] = card, self._target

    def _instance(self, card):
        key = card.key("NAME")
        self._target = []
        if any(one.prefix == f"{key}." for one in self.instances):
            raise Fault(f"the instance '{card.value('NAME')}' is defined twice")
        part = card.key("PART")
        if part not in self.parts:
            raise Fault(f"there is no part '{card.value('PART')}'")
        one = Scope(card.value("NAME"), f"{key}.", list(self.parts[part][1]))
        self._target = one.cards
        self.instances.append(one)
        one.translation, one.rotation = position_of(card)

    def _end(self, card):
        wanted = ENDS[card.keyword]
        if not self._open or self._open[-1].keyword != wanted:
            raise Fault(f"there is no *{wanted} before it")
        self._open.pop()
        self._target = self.model.cards

    def _name_idle_parts(self):
        used = {id(card) for one in self.instances for card in one.cards}
        for _, cards in self.parts.values():
            for card in cards:
                if id(card) not in used:
                    self.journal.mark(card.source, UNUSED, "no instance has this part")

    def outer(self, key):
        """Returns the key of something of the assembly without the name of the assembly."""
        start = f"{self.assembly}."
        return key[len(start) :] if self.assembly and key.startswith(start) else key

    def instance(self, name):
        """Returns an instance by its name as written, with or without that of the assembly. Raises
        Fault."""
        key = self.outer(key_of(name))
        for one in self.instances:
            if one.prefix == f"{key}.":
                return one
        raise Fault(f"there is no instance '{name}'")


def _above(number):
    """Returns an offset that is not less than a number and has few digits that are not zero, so
    that one can read the number in the part from the shifted one."""
    unit = 10 ** max(len(str(number)) - 1, 0)
    return -(-number // unit) * unit


def position_of(card):
    """Returns vector and matrix of x ↦ R x + t of a card with a translation, and then a rotation
    about the line from a to b by an angle in degrees."""
    rows = [
        (line, [real(field, line) if field else 0.0 for field in fields])
        for line, fields in card.rows()
    ]
    if not rows:
        return np.zeros(3), np.eye(3)
    line, numbers = rows[0]
    if len(numbers) > 3:
        raise Fault("the first line is a translation", line=line)
    shift = np.array(numbers + [0.0] * (3 - len(numbers)))
    if len(rows) == 1:
        return shift, np.eye(3)
    line, numbers = rows[1]
    if len(numbers) != 7 or len(rows) > 2:
        raise Fault("the second line has two points of the axis and an angle", line=line)
    a, b = np.array(numbers[:3]), np.array(numbers[3:6])
    if np.array_equal(a, b):
        raise Fault("the two points of the axis coincide", line=line)
    matrix = rotation_about(b - a, numbers[6])
    return matrix @ (shift - a) + a, matrix
