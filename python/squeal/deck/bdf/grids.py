# SPDX-License-Identifier: BSD-2-Clause
"""Grids: their positions, the axes of their components, and their permanent supports."""
import numpy as np

from squeal.deck.bdf.cards import Card
from squeal.deck.bdf.columns import integers, reals, table_of
from squeal.deck.journal import USED, Fault
from squeal.deck.mesh import EMPTY
from squeal.deck.model import Value

SUPPORTS = {"", "0"}
IDENTITY, PLACE, SYSTEM, TURN, HELD, SUPER = 0, 1, slice(2, 5), 5, 6, 7  # fields of GRID


class Grids:
    """Numbers, systems and coordinates of all grids as the deck gives them, in its order; `turns`
    are the systems of their components, `held` their permanent supports by number."""

    def __init__(self, deck, journal):
        self.deck, self.journal = deck, journal
        self.defaults = ["0", "0", "", "0"]  # CP, CD, PS, SEID
        self.held = {}
        self.superelements = set()
        self._parts = []
        self._default_card()
        for table, first, count in deck.tables("GRID"):
            self._chunk(table, first, count)
        parts = list(zip(*self._parts)) or [[EMPTY]] * 3 + [[np.zeros((0, 3))]]
        self.numbers, self.systems, self.turns, self.coordinates = map(np.concatenate, parts)
        self._order = np.argsort(self.numbers, kind="stable")
        for source in (source for _, source in deck.sources.get("GRID", ())):
            journal.mark(source, USED)
        if self.superelements:
            journal.choose(
                f"superelements (SEID {', '.join(sorted(self.superelements)[:5])}) are solved with"
                " the whole model"
            )

    def _default_card(self):
        for card in self.deck.each("GRDSET"):
            try:
                values = [card.integer(2, 0), card.integer(6, 0), card.word(7), card.integer(8, 0)]
                self.defaults = list(map(str, values))
                card.components(7, ())
                card.unread()
                self.journal.mark(card.source, USED)
            except Fault as fault:
                self.journal.refuse(card.source, fault.reason, fault.name, fault.line)

    def _chunk(self, table, first, count):
        place, turn, held, group = self.defaults
        rows = [] if table is not None else list(self.deck.rows("GRID", first, count))
        try:
            if table is None:
                table = table_of(rows, 8)
            if table.shape[1] != 8 or not len(table):
                raise ValueError
            columns = table.T
            numbers = integers(columns[IDENTITY])
            systems, turns = integers(columns[PLACE], place), integers(columns[TURN], turn)
            coordinates = np.column_stack([reals(column) for column in columns[SYSTEM]])
            supers = integers(columns[SUPER], group)
            if np.any(numbers < 1) or np.any(systems < 0) or np.any(turns < 0):
                raise ValueError
        except (ValueError, OverflowError):
            self._slow(rows or self.deck.rows("GRID", first, count))
            return
        self._parts.append((numbers, systems, turns, coordinates))
        self.superelements.update(map(str, np.unique(supers[supers != 0])))
        used = np.unique(columns[HELD]).astype(str).tolist()
        if all((text or held) in SUPPORTS for text in used):
            return
        for fields, line, source in rows or self.deck.rows("GRID", first, count):
            if (fields[HELD] or held) not in SUPPORTS:
                self._hold(Card("GRID", source, line, fields), int(fields[IDENTITY]))

    def _slow(self, chunk):
        rows = []
        for fields, line, source in chunk:
            card = Card("GRID", source, line, fields)
            try:
                rows.append(self._row(card))
            except Fault as fault:
                self.journal.refuse(source, fault.reason, fault.name, fault.line or line)
        if rows:
            numbers, systems, turns, coordinates = zip(*rows)
            tables = (np.array(table, np.int64) for table in (numbers, systems, turns))
            self._parts.append((*tables, np.array(coordinates, float)))

    def _row(self, card):
        number = card.identifier(1)
        system = card.integer(2, int(self.defaults[0]))
        turn = card.integer(6, int(self.defaults[1]))
        if turn == -1:
            raise Fault("grids of fluids are not supported", line=card.line)
        group = card.integer(8, int(self.defaults[3]))
        if group:
            self.superelements.add(str(group))
        coordinates = card.reals(3, 3, 0.0)
        self._hold(card, number)
        card.unread()
        return number, system, turn, coordinates

    def _hold(self, card, number):
        if card.word(7, self.defaults[2]) not in SUPPORTS:
            try:
                if not card.word(7):
                    card = Card("GRDSET", card.source, card.line, [""] * 6 + [self.defaults[2]])
                key = card.components(7), card.source
            except Fault as fault:
                self.journal.refuse(card.source, fault.reason, fault.name, fault.line)
            else:
                self.held.setdefault(key, []).append(number)

    def has(self, numbers):
        at = np.searchsorted(self.numbers, numbers, sorter=self._order)
        at = np.minimum(at, max(len(self.numbers) - 1, 0))
        return self.numbers[self._order][at] == numbers if len(self.numbers) else at < 0

    def at(self, number):
        """Returns the system and the coordinates of a grid. Raises Fault."""
        if not self.has(np.array([number]))[0]:
            raise Fault(f"grid {number} does not exist")
        last = np.searchsorted(self.numbers, number, side="right", sorter=self._order) - 1
        row = self._order[last]
        return int(self.systems[row]), self.coordinates[row]

    def fill(self, model, systems):
        """Adds nodes and the axes of their components to a model."""
        places = np.zeros_like(self.coordinates)
        for number in np.unique(self.systems).tolist():
            on = self.systems == number
            try:
                places[on] = systems.at(number).places(self.coordinates[on])
            except Fault as fault:
                self._refuse(on, fault)
        model.nodes.add(self.numbers, places)
        for turn in np.unique(self.turns[self.turns != 0]).tolist():
            on = self.turns == turn
            try:
                frames = systems.at(turn).frames(places[on])
                model.frames.update(zip(self.numbers[on].tolist(), frames))
            except Fault as fault:
                self._refuse(on, fault)

    def _refuse(self, on, fault):
        """Refuses the first one of some grids because of its systems."""
        wanted = int(self.numbers[np.flatnonzero(on)[0]])
        for fields, line, source in self.deck.rows("GRID"):
            if fields[0] == str(wanted):
                self.journal.refuse(source, f"grid {wanted}: {fault.reason}", line=line)
                return
        self.journal.refuse_model(f"grid {wanted}: {fault.reason}")

    def support(self, model, journal, without_rotations):
        """Adds the permanent supports; the rotations of nodes of solid cells do not exist."""
        state = model.state
        for (components, source), numbers in self.held.items():
            numbers = np.array(numbers, np.int64)
            name = "ps_" + "".join(str(at + 1) for at in components)
            model.node_sets.add(name.upper(), name, source, [numbers])
            inside = without_rotations(numbers)
            if np.any(inside) and max(components) > 2:
                journal.remark(source, "rotations of nodes of solid elements do not exist")
            value = Value(0.0, name.upper(), source)
            for number, cell in zip(numbers.tolist(), inside.tolist()):
                for at in components:
                    if at < 3 or not cell:
                        state.supports[number, at] = value
