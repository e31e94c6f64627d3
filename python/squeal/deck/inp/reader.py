# SPDX-License-Identifier: BSD-2-Clause
"""From the cards of a deck to its model."""
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from squeal.deck.inp import contacts, couplings, generate, joints  # noqa: F401 (handlers)
from squeal.deck.inp import materials, mesh, squeal, state, surfaces  # noqa: F401
from squeal.deck.inp.amplitudes import Clock
from squeal.deck.inp.assembly import Structure
from squeal.deck.inp.cards import read_cards
from squeal.deck.inp.detect import detect
from squeal.deck.inp.dialect import ABAQUS, OUTPUT, PROCEDURES
from squeal.deck.inp.handlers import TABLE, settle
from squeal.deck.inp.lines import read_lines
from squeal.deck.inp.names import Names
from squeal.deck.inp.parameters import substitute
from squeal.deck.journal import TRANSLATED, UNUSED, USED, Fault
from squeal.deck.mesh import Instance
from squeal.deck.model import Model, Squeal
from squeal.deck.numbers import integer, real

GENERAL = "general contact is not supported; use *CONTACT PAIR"
REASONS = {
    **{name: "shells are not supported" for name in ("SHELL SECTION", "MEMBRANE SECTION")},
    "BEAM SECTION": "beams are not supported",
    "TEMPERATURE": "temperatures and their strains are not supported",
    "GAP": "gap elements are not supported",
    "NMAP": "mapped nodes are not supported; write their coordinates into the deck",
    "CONNECTOR SECTION": "connectors are not supported; use springs, dashpots or a coupling",
    **dict.fromkeys(("CONTACT", "CONTACT INCLUSIONS", "CONTACT PROPERTY ASSIGNMENT"), GENERAL),
    "BUCKLE": "buckling loads are not computed",
}
BELONGS = "this card belongs after *STEP"
OF_STEPS = {"CLOAD", "DLOAD", "DSLOAD", "CHANGE FRICTION"}


def _reason(card):
    if card.keyword in REASONS:
        return REASONS[card.keyword]
    if card.keyword in SUPPORTED:
        return BELONGS
    if card.keyword in PROCEDURES:
        return "this procedure is not computed"
    return "this card is not supported" if card.known else "unknown card"


MODES = 200  # the number if the deck has an upper limit only
SUPPORTED = ("STATIC", "FREQUENCY", "COMPLEX FREQUENCY")
# Cards of a static step that may follow free vibrations: the loads remain.
CHANGES_OF_FRICTION = {"STEP", "STATIC", "CHANGE FRICTION", "FRICTION", "END STEP", *OUTPUT}


@dataclass
class Step:
    """The step that is read: OP of the first card of each kind, and places that it has loaded.
    `frequency`: it computes modes; `timed`: it is static; `only_friction`: it changes nothing but
    friction."""

    frequency: bool = False
    timed: bool = False
    after_static: bool = False
    only_friction: bool = False
    perturbation: bool = False
    request: Squeal = None
    operations: dict = field(default_factory=dict)
    loaded: set = field(default_factory=set)


class Reader(Names):
    """Applies cards to a model; following cards describe `material` and `interaction`."""

    def __init__(self, model, dialect, journal):
        super().__init__(model, journal)
        self.dialect = dialect
        self.material = self.interaction = None
        self.changes_friction = False  # the next law of friction replaces one
        self.described = {}  # the elements that have a property, by its name
        self.step = Step()
        self.clock = Clock()

    def read(self, cards):
        """Reads the nodes, elements and sets of all scopes, then their surfaces, then the rest."""
        self.structure = Structure(cards, self.journal)
        self.model.nodes.label = self.model.node_label
        scopes = [*self.structure.instances, self.structure.model]
        for number, scope in enumerate(scopes):
            self.scope = scope
            scope.open(scopes[:number])
            first = len(self.model.blocks)
            self._apply_all(self._phase(scope, 0))
            self._close(scope, self.model.blocks[first:])
        self.model.merge_blocks()
        for phase in (1, 2):
            for scope in scopes:
                self.scope = scope
                self._apply_all(self._phase(scope, phase))
        self.journal.close()

    def _phase(self, scope, phase):
        """Returns the cards of a scope that are read in a phase."""
        return [
            card
            for card in scope.cards
            if (TABLE[card.keyword].phase if card.keyword in TABLE else 2) == phase
        ]

    def _close(self, scope, blocks):
        """Adds the nodes of a scope to the model; `blocks`: its elements."""
        made = max((int(block.numbers.max()) for block in blocks), default=0)
        scope.node_numbers.close(scope.nodes.largest)
        scope.element_numbers.close(made)
        self.model.nodes.add_all(scope.nodes, scope.placed)
        if not self.structure.instances:
            return
        offsets = scope.node_numbers.offset, scope.element_numbers.offset
        self.model.instances.append(
            Instance(scope.name, *offsets, offsets[1] + scope.element_numbers.top)
        )
        for block in blocks if scope.name else ():
            self._require_own_nodes(block, scope)

    def _require_own_nodes(self, block, scope):
        """An element that is generated may have numbers of another instance."""
        own = scope.nodes.has(block.nodes)
        if not np.all(own):
            row = np.flatnonzero(~np.all(own, axis=1))[0]
            element = block.numbers[row] - scope.element_numbers.offset
            node = block.nodes[row][~own[row]][0] - scope.node_numbers.offset
            reason = f"element {element} of {scope.name}: there is no node {node} of {scope.name}"
            self.journal.refuse(block.source, reason)

    def _apply_all(self, rest):
        at = 0
        while at < len(rest):
            if rest[at].keyword == "STEP":
                end = at + 1
                while end < len(rest) and rest[end].keyword not in ("STEP", "END STEP"):
                    end += 1
                ended = end < len(rest) and rest[end].keyword == "END STEP"
                self._step(rest[at : end + ended])
                at = end + ended
            else:
                if rest[at].keyword in OF_STEPS:
                    self.journal.refuse(rest[at].source, BELONGS)
                else:
                    self._apply(rest[at])
                at += 1

    def _apply(self, card):
        """Lets the handler of a card work, or refuses the card."""
        handler = TABLE.get(card.keyword)
        try:
            if card.keyword in OUTPUT:
                self.journal.mark(card.source, UNUSED, "output of the other program")
            elif handler is None:
                raise Fault(_reason(card))
            else:
                settle(card, handler, self.journal)
                handler.function(card, self)
        except Fault as fault:
            self.journal.refuse(card.source, fault.reason, fault.name, fault.line)
        else:
            if not self.journal.entries[card.source].status:
                self.journal.mark(card.source, USED)

    def _step(self, cards):
        procedure = next((card for card in cards if card.keyword in PROCEDURES), None)
        name = procedure.keyword if procedure else None
        supported = name in SUPPORTED
        if procedure and not supported and self.journal.ignores(name):
            for card in cards:
                self.journal.mark(card.source, UNUSED, f"in the step of *{name}, which is ignored")
            return
        if procedure is None:
            self.journal.refuse(cards[0].source, "the step has no procedure")
        if cards[-1].keyword != "END STEP":
            self.journal.refuse(cards[0].source, "*END STEP is missing: the deck may be cut off")
        only_friction = all(card.keyword in CHANGES_OF_FRICTION for card in cards)
        self.step = Step(
            name in ("FREQUENCY", "COMPLEX FREQUENCY"),
            name == "STATIC",
            self.model.static is not None,
            only_friction,
        )
        self.interaction = None
        self._open_step(cards[0], name)
        if name == "STATIC":
            self._begin(procedure)
        for card in cards[1:]:
            if card is procedure and supported:
                self._procedure(card)
            elif card.keyword == "END STEP":
                self.journal.mark(card.source, USED)
            elif card.keyword == "BOUNDARY" and self.step.frequency and self.step.after_static:
                self.journal.refuse(card.source, "supports that change after the static step")
            else:
                self._apply(card)
        squeal.add_request(self)
        self.step = Step()

    def _begin(self, procedure):
        try:
            self.clock.begin(procedure)
        except Fault as fault:
            self.journal.refuse(procedure.source, fault.reason, fault.name, fault.line)

    def _open_step(self, card, procedure):
        journal = self.journal
        journal.mark(card.source, USED)
        if card.data:
            journal.remark(card.source, "the title of the step is not used")
        for name, value in card.parameters.items():
            if name == "NLGEOM" and (value or "YES").upper() != "NO":
                self._large_displacements(card.source)
            elif name == "PERTURBATION" and procedure in ("FREQUENCY", "COMPLEX FREQUENCY"):
                self.step.perturbation = True
            elif name in ("INC", "INCF", "NAME", "NLGEOM", "AMPLITUDE", "UNSYMM", "EXTRAPOLATION"):
                journal.remark(card.source, f"{name} is not used")
            else:
                journal.refuse(card.source, "this parameter is not supported", name)

    def _large_displacements(self, source):
        """Refuses them. If they are ignored, free vibrations have the stress of the static step, as
        in the program of the deck."""
        reason = "large displacements are not supported; --ignore NLGEOM takes them as small"
        if not self.journal.refuse(source, reason, "NLGEOM"):
            self.model.large_displacements = True

    def _procedure(self, card):
        journal = self.journal
        if card.keyword == "COMPLEX FREQUENCY":
            try:
                squeal.request(card, self)
            except Fault as fault:
                journal.refuse(card.source, fault.reason, fault.name, fault.line)
            return
        idle = {"SOLVER", "STORAGE", "DIRECT", "EIGENSOLVER", "NORMALIZATION", "STABILIZE", "SIM"}
        idle.add("ACOUSTIC COUPLING")
        for name in card.parameters:
            if name in idle:
                journal.remark(card.source, f"{name} is not used")
            else:
                journal.refuse(card.source, "this parameter is not supported", name)
        try:
            if card.keyword == "FREQUENCY":
                self._frequency(card)
            else:
                self._static(card)
        except Fault as fault:
            journal.refuse(card.source, fault.reason, fault.name, fault.line)

    def _frequency(self, card):
        rows = list(card.rows())
        if not rows:
            raise Fault("the number of frequencies is missing")
        if len(rows) > 1:
            raise Fault("this card has one line of data", line=rows[1][0])
        line, fields = rows[0]
        model, abaqus = self.model, self.dialect is ABAQUS
        if model.static and self.step.perturbation:
            self.decide()
        prestress = model.large_displacements if abaqus else self.step.perturbation
        if model.frequencies and model.prestress != prestress:
            raise Fault("steps of free vibrations with and without PERTURBATION")
        model.prestress = prestress
        count, model.top = (integer(fields[0], line) if fields[0] else None), None
        if count is not None and count <= 0:
            raise Fault("the number of frequencies is not positive", line=line)
        if abaqus and len(fields) > 2 and fields[2]:
            model.top = real(fields[2], line)
        if count is None and model.top is None:
            raise Fault("the number of frequencies is missing", line=line)
        if len(fields) > (3 if abaqus else 1) or abaqus and any(fields[1:2]):
            self.journal.remark(card.source, "only the number and the upper limit are used")
        model.frequencies = max(count or MODES, model.frequencies or 0)
        if count is None:
            self.journal.choose(
                f"{card.source}: the modes up to {model.top:g} Hz; the case computes {MODES}, see"
                " whether they reach this limit"
            )
        model.frequency = card.source
        if model.static and not prestress:
            self.journal.choose(
                f"{card.source}: frequencies without the stress of the static step"
                if abaqus
                else f"{card.source}: frequencies without the effect of the static step"
            )
        if prestress and not abaqus:
            self.step.request = Squeal(card.source, {}, False, count)
        self.journal.mark(card.source, TRANSLATED)

    def _static(self, card):
        if self.model.static:
            self.journal.choose(
                f"{card.source}: the case has the state at the end of this static step, not those"
                " of earlier ones"
            )
        if self.model.frequencies is not None and not self.step.only_friction:
            raise Fault(
                "a static step after one of free vibrations is not supported, unless it only"
                " changes friction"
            )
        if card.data:
            self.journal.remark(card.source, "increments are not used: the step is linear")
        self.model.static = card.source
        self.journal.mark(card.source, TRANSLATED)

    def decide(self):
        """Raises Fault if the deck may be for either program, which read the card differently."""
        if not self.dialect.decided:
            raise Fault(
                "Abaqus and CalculiX read it differently; choose --dialect abaqus or calculix"
            )


def read_model(path, dialect, journal):
    """Returns the model of a deck; the journal then has an entry for each card. `dialect` None: the
    one that is detected. Raises DeckError if a file cannot be read."""
    lines = substitute(read_lines(path, journal), journal)
    if dialect is None:
        dialect, reason = detect(lines)
        journal.choose(f"dialect: {dialect.name}, {reason}")
    cards = read_cards(lines, dialect, journal)
    model = Model(" ".join(Path(path).name.split()), dialect.name)
    Reader(model, dialect, journal).read(cards)
    return model
