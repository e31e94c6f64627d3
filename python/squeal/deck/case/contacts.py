# SPDX-License-Identifier: BSD-2-Clause
"""Contacts of a case: frictionless interfaces of two surfaces of faces.

A penalty that stands for hard contact is left out; a softer one is a layer that is part of the
physics.
"""
import numpy as np

from squeal.deck.case.groups import FACES
from squeal.deck.journal import TRANSLATED, UNUSED, Fault

# Least stiffness of a penalty over that of the cells of the slave, k h / E, for hard contact.
HARD = 20


def add_contacts(model, case, journal, faces):
    used = {contact.interaction for contact in model.contacts}
    for key, one in model.interactions.items():
        for source in (one.source, one.behavior, one.friction):
            if source is not None and key not in used:
                journal.mark(source, UNUSED, "no contact pair has this interaction")
    taken = {}
    for contact in model.contacts:
        try:
            _add(contact, model, case, journal, faces, taken)
            journal.mark(contact.source, TRANSLATED)
        except Fault as fault:
            journal.refuse_fault(contact.source, fault)


def _add(contact, model, case, journal, faces, taken):
    interaction = model.interactions.get(contact.interaction)
    if interaction is None:
        raise Fault(f"there is no interaction '{contact.interaction}'")
    if interaction.friction is not None:
        journal.refuse(
            interaction.friction,
            "friction is not translated: it needs a sliding motion, which the deck does not have",
        )
    stem = f"contact_{contact.source.line}"
    taken[stem] = taken.get(stem, 0) + 1
    path = ("contact", stem if taken[stem] == 1 else f"{stem}_{taken[stem]}")
    for key, name in (("pad", contact.slave), ("disc", contact.master)):
        surface = model.surfaces[name]
        if surface.nodes is not None:
            raise Fault(f"the surface '{surface.name}' of a contact has nodes in place of faces")
        rows = np.column_stack([surface.elements, surface.faces])
        faces.require_outer([tuple(row) for row in rows.tolist()])
        case.set((*path, key), case.group(FACES, rows, surface.name), contact.source)
        if key == "pad":
            _set_stiffness(interaction, model, case, journal, path, rows, faces)
    case.set((*path, "role"), "frictionless", contact.source)
    case.set((*path, "slave"), "pad", contact.source)
    case.set((*path, "gap"), "measured", contact.source)
    for source in (interaction.source, interaction.behavior):
        if source is not None:
            journal.mark(source, TRANSLATED)


def _set_stiffness(interaction, model, case, journal, path, rows, faces):
    """A penalty k is a soft layer if k h / E is below HARD; h: edge of the faces, E: largest
    modulus."""
    if interaction.stiffness is None:
        calculix = "" if model.program == "Abaqus" else "; in CalculiX it is a stiff penalty"
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
