# SPDX-License-Identifier: BSD-2-Clause
"""Contacts of a case: interfaces of two surfaces of faces, which slide if one side moves.

A penalty that stands for hard contact is left out; a softer one is a layer that is part of the
physics.
"""
from dataclasses import dataclass

import numpy as np

from squeal.deck.case.frictions import Frictions, coefficient
from squeal.deck.case.groups import FACES
from squeal.deck.case.reached import count_reached
from squeal.deck.case.sliding import Bodies, moving_bodies
from squeal.deck.journal import TRANSLATED, UNUSED, Fault

# Least stiffness of a penalty over that of the cells of the slave, k h / E, for hard contact.
HARD = 20


def add_contacts(model, case, journal, faces):
    """Sets the interfaces and motions of a case. Returns the frictions of what slides, None if
    nothing does, and the motions whose speed the deck does not have."""
    used = {contact.interaction for contact in model.contacts}
    for key, one in model.interactions.items():
        for source in (one.source, one.behavior, *(law.source for law in one.frictions)):
            if source is not None and key not in used:
                journal.mark(source, UNUSED, "no contact pair has this interaction")
    bodies = Bodies(model, case, faces)
    contacts = _sound(model, journal, faces)
    moving = moving_bodies(model, contacts, bodies, case, journal)
    taken, sides = {}, []
    for contact in contacts:
        try:
            sides.append(_sides(contact, model, bodies, moving))
        except Fault as fault:
            journal.refuse_fault(contact.source, fault)
    rubbing = [one.contact.interaction for one in sides if one.slides]
    frictions = Frictions(model, list(dict.fromkeys(rubbing))) if rubbing else None
    for one in sides:
        try:
            path = _path(one.contact, taken)
            _add(one, path, model, case, journal, faces)
            _set_role(one, path, model, case, journal, frictions)
            journal.mark(one.contact.source, TRANSLATED)
        except Fault as fault:
            journal.refuse_fault(one.contact.source, fault)
    return frictions, [one for one in moving.values() if not one.known]


def _sound(model, journal, faces):
    """Returns the contacts with an interaction and two surfaces of outer faces; refuses others."""
    found = []
    for contact in model.contacts:
        try:
            if contact.interaction not in model.interactions:
                raise Fault(f"there is no interaction '{contact.interaction}'")
            for key in (contact.slave, contact.master):
                surface = model.surfaces[key]
                if surface.nodes is not None:
                    raise Fault(
                        f"the surface '{surface.name}' of a contact has nodes in place of faces"
                    )
                faces.require_outer([tuple(row) for row in surface.rows.tolist()])
            found.append(contact)
        except Fault as fault:
            journal.refuse_fault(contact.source, fault)
    return found


@dataclass
class Sides:
    """Keys of the two surfaces of a contact; `disc` is the one that moves, if one does."""

    contact: object
    pad: str
    disc: str
    moves: bool
    slides: bool  # with friction


def _sides(contact, model, bodies, moving):
    motions = []
    for name in (contact.slave, contact.master):
        owners = bodies.of_elements(model.surfaces[name].elements)
        motions.append({id(moving[at].motion) for at in owners if at in moving})
    if motions[0] == motions[1]:
        return Sides(contact, contact.slave, contact.master, False, False)
    if all(motions) or max(map(len, motions)) > 1:
        raise Fault("both sides of a contact move, in different ways")
    pad, disc = (contact.master, contact.slave) if motions[0] else (contact.slave, contact.master)
    laws = model.interactions[contact.interaction].frictions
    if any(not law.coefficients for law in laws):
        raise Fault("a contact that slides has ROUGH friction")
    return Sides(contact, pad, disc, True, bool(laws))


def _path(contact, taken):
    stem = f"contact_{contact.source.line}"
    taken[stem] = taken.get(stem, 0) + 1
    return ("contact", stem if taken[stem] == 1 else f"{stem}_{taken[stem]}")


def _add(sides, path, model, case, journal, faces):
    contact = sides.contact
    interaction = model.interactions[contact.interaction]
    for key, name in (("pad", sides.pad), ("disc", sides.disc)):
        surface = model.surfaces[name]
        case.set((*path, key), case.group(FACES, surface.rows, surface.name), contact.source)
        if name == contact.slave:
            _set_stiffness(interaction, model, case, journal, path, surface.rows, faces)
    case.set((*path, "slave"), "pad" if sides.pad == contact.slave else "disc", contact.source)
    case.set((*path, "gap"), _gap(contact, model, faces), contact.source)
    slave, master = model.surfaces[contact.slave], model.surfaces[contact.master]
    reached, beyond = count_reached(slave, master, faces, None)
    case.contacts.append((path[-1], reached, beyond))
    if not reached:
        journal.choose(f"{contact.source}: no node of the slave is within reach of the master")
    if not interaction.separation:
        case.set((*path, "separation"), False, interaction.behavior)
    for source in (interaction.source, interaction.behavior):
        if source is not None:
            journal.mark(source, TRANSLATED)


def _gap(contact, model, faces):
    """ADJUST moves the slave nodes within a distance onto the master: all of them, or none."""
    if contact.adjust is None:
        return "measured"
    slave, master = model.surfaces[contact.slave], model.surfaces[contact.master]
    surface = faces.surface(master.rows)
    points = model.nodes.at(faces.nodes_of(slave))
    owners, _ = surface.assign(points, surface.size, contact.adjust + 1e-6 * surface.size)
    near = int(np.sum(owners >= 0))
    if near == len(points):
        return 0.0
    if not near:
        return "measured"
    raise Fault(
        f"ADJUST moves {near} of {len(points)} slave nodes onto the master; all of them or none"
        " are supported",
        "ADJUST",
    )


def _set_role(sides, path, model, case, journal, frictions):
    """Without motion, friction holds up to its limit: nodes beyond it slide."""
    contact = sides.contact
    laws = model.interactions[contact.interaction].frictions
    if sides.slides:
        case.set((*path, "role"), "sliding", contact.source)
        ratio = frictions.ratio(contact.interaction)
        if ratio is None:
            case.set((*path, "friction"), frictions.final(contact.interaction), laws[-1].source)
        elif ratio != 1:
            case.set((*path, "friction_factor"), ratio, laws[-1].source)
        return
    limit = laws[-1] if laws else None
    if limit is None or limit.coefficients and not coefficient(limit):
        case.set((*path, "role"), "frictionless", contact.source)
    else:
        case.set((*path, "role"), "sticking", contact.source)
    for law in laws:
        journal.mark(law.source, TRANSLATED)
    if limit is not None and limit.coefficients and coefficient(limit):
        value = limit.coefficients[0]
        case.set((*path, "friction"), value, limit.source)
        case.set((*path, "release"), True, limit.source)
        journal.choose(
            f"{contact.source}: no side moves; its nodes stick up to the limit {value:g} of"
            " friction, and slide beyond it"
        )


def _set_stiffness(interaction, model, case, journal, path, rows, faces):
    """A penalty k is a soft layer if k h / E is below HARD; h: edge of the faces, E: largest
    modulus."""
    if interaction.stiffness is None:
        calculix = (
            "" if model.program in ("Abaqus", "Nastran") else "; in CalculiX it is a stiff penalty"
        )
        journal.choose(f"{interaction.source}: contact is hard{calculix}")
        return
    corners = [model.nodes.at(nodes) for nodes in faces.nodes(rows)]
    edges = [np.linalg.norm(face[1] - face[0]) for face in corners]
    moduli = [max(one.constants) for one in model.materials.values() if one.law]
    if not edges or not moduli:
        raise Fault("the surface of a contact has no faces or no stiffness")
    ratio = interaction.stiffness * float(np.mean(edges)) / max(moduli)
    if ratio < HARD:
        case.set((*path, "stiffness"), interaction.stiffness, interaction.behavior)
        journal.choose(
            f"{interaction.behavior}: the penalty is {ratio:.3g} times as stiff as the cells, and"
            " becomes a soft layer on the slave"
        )
    else:
        journal.choose(
            f"{interaction.behavior}: contact is hard; the penalty is {ratio:.3g} times as stiff as"
            " the cells"
        )
