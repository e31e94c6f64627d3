# SPDX-License-Identifier: BSD-2-Clause
"""From the cards of a Nastran deck to its model."""
from pathlib import Path

import numpy as np

from squeal.deck.bdf import contacts, loads, materials, methods, regions  # noqa: F401
from squeal.deck.bdf import rigid, springs, squeal, supports  # noqa: F401
from squeal.deck.bdf.cards import Deck
from squeal.deck.bdf.control import read_control, select
from squeal.deck.bdf.grids import Grids
from squeal.deck.bdf.handlers import BLOCKS, LOADS, PROPERTIES, REASONS, TABLE, WITHOUT_EFFECT
from squeal.deck.bdf.lines import read_sections
from squeal.deck.bdf.solids import KINDS, Solids
from squeal.deck.bdf.systems import Systems
from squeal.deck.journal import UNUSED, USED, Fault, Missing
from squeal.deck.mesh import EMPTY
from squeal.deck.model import Model

WORDS = {
    **{"SOLID SECTION": "PSOLID", "ELASTIC": "MAT1 or MAT9", "DENSITY": "RHO"},
    **{"TRANSFORM": "CD", "KINEMATIC": "RBE2"},
}
PROGRAM = "Nastran"
READ = {*KINDS, "GRID", "GRDSET", "PARAM", "LOAD", "SPCADD", "MPCADD", "BCTADD", "BGADD"}
READ |= {f"CORD{form}{letter}" for form in "12" for letter in "RCS"}
ELEMENTS = ("C", "RBE", "RBAR", "RROD", "RSPLINE", "RTRPLT", "GENEL", "DMIG")  # of missing cards


class Reader:
    """Applies cards to a model. `properties`: quadrature by number; `constants`: those of springs
    by card and number; `doubled`: grids of solid cells that are reference nodes as well."""

    def __init__(self, model, journal, deck, control, selection):
        self.model, self.journal, self.deck = model, journal, deck
        self.control, self.selection = control, selection
        self.parameters, self.properties, self.constants = {}, {}, {}
        self.orientations, self.methods, self.masses = [], set(), {}
        self.mass_numbers = set()  # of CONM2
        self.doubled = set()
        self.regions, self.contact_bodies, self.contact_parameters = {}, {}, {}
        self.brake_motions, self.brake_properties, self.squeals = {}, {}, {}
        self.connections = self.all_squeal = self._outside = None
        self.friction_type = "0"
        self.cells = EMPTY  # numbers of the elements, sorted
        self._cells = EMPTY
        methods.read_parameters(self)
        self.mass_factor = self.parameters.get("WTMASS", 1.0)

    def solid(self, element, line):
        """Returns shape and grids of a solid element. Raises Missing."""
        (block,), (row,) = self.model.find_elements(np.array([element]))
        if block < 0:
            raise Missing(f"{element} is not the number of a solid element", line=line)
        one = self.model.blocks[block]
        return one.shape, one.nodes[row].tolist()

    def read(self):
        model, journal, deck = self.model, self.journal, self.deck
        grids = Grids(deck, journal)
        self.systems = Systems(journal, grids.at)
        self.systems.read(deck)
        grids.fill(model, self.systems)
        self.solids = Solids(deck, journal)
        self._phase(0)
        materials.orient(self)
        methods.damp(self)
        self.solids.fill(model, materials.quadrature(self))
        model.merge_blocks()
        self._cells = np.unique(np.concatenate([EMPTY, *(b.nodes.ravel() for b in model.blocks)]))
        self.cells = np.sort(np.concatenate([EMPTY, *(b.numbers for b in model.blocks)]))
        self._select()
        self._phase(1)
        grids.support(model, journal, self.without_rotations)
        self._phase(2)
        self._phase(3)
        self._phase(4)
        squeal.finish(self)
        regions.name_idle(self)
        self._rest()
        self._finish()
        journal.close()

    def _select(self):
        chosen = self.selection
        self.spc_sets = supports.sets_of(self, "spc", "SPCADD", ("SPC", "SPC1"))
        self.mpc_sets = supports.sets_of(self, "mpc", "MPCADD", ("MPC",))
        pairs = ("BCTSET", "BCTABLE", "BCTABL1", "BCONECT")
        self.contact_sets = supports.sets_of(self, "contact", "BCTADD", pairs)
        self.glue_sets = supports.sets_of(self, "glue", "BGADD", ("BGSET",))
        self.load_factors = loads.factors_of(self)
        self.spcd_sets = None if chosen.everything else {chosen.load}

    def _phase(self, phase):
        for name in self.deck.chains:
            handler = TABLE.get(name)
            if handler is None or handler.phase != phase:
                continue
            for card in self.deck.each(name):
                try:
                    handler.function(card, self)
                    card.unread()
                    if card.passed:
                        places = ", ".join(card.passed)
                        self.journal.remark(card.source, f"not used: field {places}")
                    if not self.journal.entries[card.source].status:
                        self.journal.mark(card.source, USED)
                except Fault as fault:
                    line = fault.line or card.line
                    self.journal.refuse(card.source, fault.reason, fault.name, line)

    def _rest(self):
        """Cards that are not translated."""
        for name, sources in self.deck.sources.items():
            if name in TABLE or name in READ:
                continue
            sets = {fields[0] for fields, _, _ in self.deck.rows(name)} if name in LOADS else ()
            for _, source in sources:
                if sets and not any(one in sets for one in map(str, self.load_factors)):
                    self.journal.mark(source, UNUSED, "its set is not selected")
                else:
                    self._idle(name, source)

    def _idle(self, name, source):
        journal = self.journal
        loaded = self.model.static is not None or self.selection.load is not None
        if name in WITHOUT_EFFECT:
            journal.mark(source, UNUSED, WITHOUT_EFFECT[name])
        elif name in PROPERTIES:
            journal.mark(source, UNUSED, "a property of elements that are not solid")
        elif name == "SUPORT" and not loaded:
            journal.mark(source, UNUSED, "without effect on free vibrations")
        elif name.startswith("TEMP") and self.selection.everything:
            journal.refuse(source, "temperatures and their strains are not supported")
        elif name.startswith("TEMP") or name.startswith("TABLE"):
            journal.mark(source, UNUSED, "nothing that is translated selects it")
        else:
            refused = journal.refuse(source, REASONS.get(name, "this card is not supported"))
            journal.incomplete |= refused and name.startswith(ELEMENTS)

    def _finish(self):
        model, selection, journal = self.model, self.selection, self.journal
        state = model.state
        state.global_forces = True
        loaded = state.forces or state.pressures or state.body_loads or state.gravity
        if selection.everything:
            loads_of = [*state.forces.values(), *state.pressures.values()]
            sources = [one.source for one in loads_of + state.body_loads]
            sources += [state.gravity[1]] if state.gravity else []
            model.static = sources[0] if loaded else None
        else:
            model.static = selection.static
            if selection.frequency is not None and model.frequencies is None:
                if selection.method is None:
                    model.frequency, model.frequencies = selection.frequency, methods.MANY
                    journal.choose(f"{selection.frequency}: {methods.MANY} free modes")
                else:
                    journal.refuse(
                        selection.frequency, f"no EIGRL or EIGR has the number {selection.method}"
                    )
        model.prestress = selection.prestress
        solids = {block.kind for block in model.blocks}
        if model.frequencies and solids and self.parameters.get("COUPMASS", -1) < 0:
            journal.choose(
                "masses of elements are consistent; Nastran lumps them without PARAM,COUPMASS,1"
            )
        if any(kind in ("CHEXA20", "CPENTA15", "CPENTA6") for kind in solids):
            journal.choose(
                "elements have the full quadrature; that of Nastran has fewer points for shear"
                " unless ISOP of PSOLID is FULL"
            )

    def grids_in(self, ranges, card):
        """Returns the grids of ranges in their order: a single one must exist, of others those that
        do. Raises Fault."""
        known, parts = self.model.nodes.numbers, []
        for first, last in ranges:
            low, high = np.searchsorted(known, [first, last + 1])
            if first == last and low == high:
                raise Fault(f"grid {first} does not exist", line=card.line)
            if low == high:
                raise Fault(f"there are no grids {first} THRU {last}", line=card.line)
            if high - low < last - first + 1:
                self.journal.remark(card.source, f"not all grids {first} THRU {last} are there")
            parts.append(known[low:high])
        numbers = np.concatenate([EMPTY, *parts])
        _, at = np.unique(numbers, return_index=True)
        return numbers[np.sort(at)]

    def in_cells(self, numbers):
        return np.isin(numbers, self._cells)

    def without_rotations(self, numbers):
        """Returns for each grid whether it has no rotations: grids of solid cells, unless a rigid
        element has made them reference nodes."""
        found = self.in_cells(numbers)
        if self.doubled:
            found &= ~np.isin(numbers, np.array(sorted(self.doubled), np.int64))
        return found

    def axes_at(self, number):
        """Returns the axes of the components of a grid as rows. Raises Fault."""
        place = self.model.nodes.at([number])[0]
        frame = self.model.frames.get(number)
        return np.eye(3) if frame is None else frame.axes_at(place)

    def basic_terms(self, terms):
        """Returns terms (grid, component, coefficient) in global axes. Raises Fault."""
        found = []
        for number, component, value in terms:
            self.model.nodes.at([number])
            if self.model.frames.get(number) is None:
                found.append((number, component, value))
                continue
            axis = self.axes_at(number)[component % 3]
            first = 0 if component < 3 else 3
            found += [(number, first + at, value * axis[at]) for at in range(3) if axis[at]]
        return found

    def outside(self):
        """Returns the outer faces of the model."""
        if self._outside is None:
            self._outside = regions.Outside(self.model)
        return self._outside

    def load_source(self):
        """Returns the source of what selects the loads."""
        return self.selection.static or self.deck.sources["LOAD"][0][1]

    def new_node(self, place):
        """Adds a node, and returns its number."""
        number = 1 + int(self.model.nodes.numbers.max())
        self.model.nodes.add([number], [place])
        return number


def read_model(path, journal, subcase=None):
    """Returns the model of a deck; the journal then has an entry for each card, or for cards of one
    name in sequence. Raises DeckError if a file cannot be read."""
    head, bulk, marks = read_sections(path, journal)
    control = read_control(head, journal)
    selection = select(control, subcase, journal)
    model = Model(" ".join(Path(path).name.split()), PROGRAM)
    model.words = WORDS
    for source in marks:
        if source.card != "ENDDATA":
            journal.mark(source, USED)
    deck = Deck(bulk, journal, BLOCKS)
    for source in marks:
        journal.mark(source, USED)
    Reader(model, journal, deck, control, selection).read()
    return model
