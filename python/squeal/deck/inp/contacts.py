# SPDX-License-Identifier: BSD-2-Clause
"""Cards of contact: pairs of surfaces, their interactions and the laws of friction."""
from squeal.deck.inp.amplitudes import factor_of
from squeal.deck.inp.dialect import ABAQUS
from squeal.deck.inp.handlers import handles
from squeal.deck.journal import Fault
from squeal.deck.model import Contact, Friction, Interaction
from squeal.deck.numbers import real

TYPES = ("NODETOSURFACE", "SURFACETOSURFACE", "MORTAR", "LINMORTAR", "PGLINMORTAR")


@handles("SURFACE INTERACTION", used=("NAME",), idle=("PAD THICKNESS",))
def surface_interaction(card, reader):
    key = card.key("NAME")
    if key in reader.model.interactions:
        raise Fault(f"the interaction '{card.require('NAME')}' is defined twice")
    if card.data:
        # Abaqus: the thickness of a plane model.
        reader.journal.remark(card.source, f"line {card.data[0][0]} is not used: no plane model")
    reader.interaction = reader.model.interactions[key] = Interaction(card.source)
    reader.changes_friction = False


def _interaction(reader):
    if reader.interaction is None:
        raise Fault(
            "this card belongs after *SURFACE INTERACTION or, in a step, after *CHANGE FRICTION"
        )
    return reader.interaction


@handles(
    "SURFACE BEHAVIOR",
    used=("PRESSURE-OVERCLOSURE", "NO SEPARATION"),
    idle=("PENALTY", "DIRECT", "AUGMENTED LAGRANGE"),
)
def surface_behavior(card, reader):
    """`hard` contact, by any method of the other program, or a pressure that is proportional to the
    penetration."""
    one = _interaction(reader)
    if one.behavior:
        raise Fault("the interaction has two laws of contact")
    kind = card.key("PRESSURE-OVERCLOSURE", "HARD")
    if kind not in ("HARD", "LINEAR"):
        raise Fault(f"PRESSURE-OVERCLOSURE={kind} is not supported")
    one.behavior = card.source
    one.separation = "NO SEPARATION" not in card.parameters
    rows = list(card.rows())
    if kind == "LINEAR":
        if len(rows) != 1:
            raise Fault("LINEAR needs one line with the stiffness")
        line, fields = rows[0]
        one.stiffness = real(fields[0], line)
        if one.stiffness <= 0:
            raise Fault("the stiffness is not positive", line=line)
        if len(fields) > 1:
            reader.journal.remark(card.source, "tension and clearance at infinity are not used")
    elif rows:
        raise Fault("HARD has no lines of data", line=rows[0][0])


@handles(
    "FRICTION",
    used=("EXPONENTIAL DECAY", "ROUGH"),
    idle=("SLIP TOLERANCE", "ELASTIC SLIP", "LAGRANGE", "STABILIZE"),
)
def friction(card, reader):
    """A law of friction. One that follows *CHANGE FRICTION is ramped from the earlier one."""
    one = _interaction(reader)
    if one.frictions and not reader.changes_friction:
        raise Fault("the interaction has two laws of friction")
    one.frictions.append(_law(card, reader))
    reader.changes_friction = False


def _law(card, reader):
    rows = list(card.rows())
    if "ROUGH" in card.parameters:
        if rows:
            raise Fault("ROUGH has no lines of data", line=rows[0][0])
        return Friction(card.source)
    if not rows:
        raise Fault("the coefficient of friction is missing")
    table = [[real(field or "0", line) for field in fields] for line, fields in rows]
    for (line, _), values in zip(rows, table):
        if any(value < 0 for value in values):
            raise Fault("numbers of a law of friction are not negative", line=line)
    if "EXPONENTIAL DECAY" in card.parameters:
        if len(table) != 1 or len(table[0]) != 3:
            raise Fault("EXPONENTIAL DECAY needs one line: two coefficients and the decay")
        return Friction(card.source, tuple(table[0][:2]), decay=table[0][2])
    if len(table) > 1 or len(table[0]) > 1:
        reader.decide()
    if reader.dialect is not ABAQUS:
        if len(table) > 1:
            raise Fault("CalculiX has one line: coefficient and stick slope")
        if len(table[0]) > 1:
            reader.journal.remark(card.source, "the stick slope is not used: friction is exact")
        return Friction(card.source, (table[0][0],))
    for (line, _), values in zip(rows, table):
        if len(values) > 2 and any(values[2:]):
            raise Fault("friction that depends on pressure or temperature", line=line)
    speeds = tuple(values[1] if len(values) > 1 else 0.0 for values in table)
    if any(after <= before for before, after in zip(speeds, speeds[1:])):
        raise Fault("slip rates of a table of friction have to ascend")
    return Friction(card.source, tuple(values[0] for values in table), speeds)


@handles("CHANGE FRICTION", used=("INTERACTION", "AMPLITUDE"), lines=0)
def change_friction(card, reader):
    key = card.key("INTERACTION")
    if key not in reader.model.interactions:
        raise Fault(f"there is no interaction '{card.require('INTERACTION')}'")
    if factor_of(card, reader) != 1:
        raise Fault("the amplitude does not end at 1: friction between two values", "AMPLITUDE")
    reader.interaction = reader.model.interactions[key]
    reader.changes_friction = True


@handles(
    "CONTACT PAIR",
    used=("INTERACTION", "TYPE", "SMALL SLIDING", "ADJUST"),
    idle=("NO THICKNESS", "TRACKING", "SUPPLEMENTARY CONSTRAINTS", "MECHANICAL CONSTRAINT"),
)
def contact_pair(card, reader):
    default = "NODETOSURFACE" if reader.dialect is ABAQUS else None
    interaction, kind = card.key("INTERACTION"), card.key("TYPE", default)
    if kind not in TYPES:
        raise Fault(f"TYPE={card.value('TYPE') or ''} is not supported", "TYPE")
    adjust = None
    if "ADJUST" in card.parameters:
        try:
            adjust = real(card.require("ADJUST"))
        except Fault:
            raise Fault("ADJUST with a set of nodes is not supported", "ADJUST") from None
    if reader.dialect is ABAQUS and "SMALL SLIDING" not in card.parameters:
        reader.journal.choose(f"{card.source}: sliding is small, as with SMALL SLIDING")
    for line, fields in card.rows():
        if len(fields) != 2:
            raise Fault("a line has the slave and the master surface", line=line)
        surfaces = [reader.surface_of(field, line) for field in fields]
        if any([one.slave, one.master] == surfaces for one in reader.model.contacts):
            raise Fault("this pair of surfaces is given twice", line=line)
        reader.model.contacts.append(Contact(*surfaces, interaction, card.source, adjust))
