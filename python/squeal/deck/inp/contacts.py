# SPDX-License-Identifier: BSD-2-Clause
"""Cards of contact: pairs of surfaces and their interactions."""
from squeal.deck.inp.handlers import handles
from squeal.deck.journal import Fault
from squeal.deck.model import Contact, Interaction
from squeal.deck.numbers import real

TYPES = ("NODETOSURFACE", "SURFACETOSURFACE", "MORTAR", "LINMORTAR", "PGLINMORTAR")


@handles("SURFACE INTERACTION", used=("NAME",), lines=0)
def surface_interaction(card, reader):
    key = card.key("NAME")
    if key in reader.model.interactions:
        raise Fault(f"the interaction '{card.require('NAME')}' is defined twice")
    reader.interaction = reader.model.interactions[key] = Interaction(card.source)


def _interaction(reader):
    if reader.interaction is None:
        raise Fault("this card belongs after *SURFACE INTERACTION")
    return reader.interaction


@handles("SURFACE BEHAVIOR", used=("PRESSURE-OVERCLOSURE",))
def surface_behavior(card, reader):
    """`hard` contact, or a pressure that is proportional to the penetration."""
    one = _interaction(reader)
    kind = card.key("PRESSURE-OVERCLOSURE", "HARD")
    if kind not in ("HARD", "LINEAR"):
        raise Fault(f"PRESSURE-OVERCLOSURE={kind} is not supported")
    one.behavior = card.source
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


@handles("FRICTION", idle=None)
def friction(card, reader):
    _interaction(reader).friction = card.source


@handles("CONTACT PAIR", used=("INTERACTION", "TYPE", "SMALL SLIDING"))
def contact_pair(card, reader):
    interaction, kind = card.key("INTERACTION"), card.key("TYPE")
    if kind not in TYPES:
        raise Fault(f"TYPE={card.require('TYPE')} is not supported")
    for line, fields in card.rows():
        if len(fields) != 2:
            raise Fault("a line has the slave and the master surface", line=line)
        surfaces = [reader.surface_of(field, line) for field in fields]
        reader.model.contacts.append(Contact(*surfaces, interaction, card.source))
