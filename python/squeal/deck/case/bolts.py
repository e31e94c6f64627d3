# SPDX-License-Identifier: BSD-2-Clause
"""Bolts of a case: surfaces inside a body that cut a shank, and its tension."""
import numpy as np

from squeal.deck.case.groups import FACES, clean
from squeal.deck.journal import TRANSLATED, Fault


def add_bolts(model, case, journal, faces):
    for bolt in model.bolts:
        try:
            _bolt(bolt, model, case, journal, faces)
            journal.mark(bolt.source, TRANSLATED)
        except Fault as fault:
            journal.refuse_fault(bolt.source, fault)


def _bolt(bolt, model, case, journal, faces):
    if bolt.force is None:
        raise Fault(
            f"no *CLOAD gives the tension at component 1 of node {model.node_label(bolt.node)}"
        )
    surface = model.surfaces[bolt.surface]
    nodes = faces.nodes(surface.rows)
    if not nodes:
        raise Fault(f"the surface '{surface.name}' has no faces")
    outwards = _normal(model.nodes.at(nodes[0]))
    normal = outwards if bolt.normal is None else bolt.normal
    # The force acts along the normal on the side of the elements of the surface.
    force = bolt.force.value * np.sign(normal @ outwards)
    if force < 0:
        raise Fault("the force of a bolt presses its two sides together")
    path = ("bolt", clean(surface.name))
    case.set((*path, "section"), case.group(FACES, surface.rows, surface.name), bolt.source)
    case.set((*path, "force"), force, bolt.force.source)
    case.set((*path, "axis"), normal, bolt.source)
    journal.mark(bolt.force.source, TRANSLATED)
    journal.mark(surface.source, TRANSLATED)
    if not bolt.locked:
        journal.choose(
            f"{bolt.source}: the bolt has its tension in a first step, and keeps its length from"
            " then on; in the deck no *BOUNDARY, FIXED does so"
        )


def _normal(points):
    """Returns the outward normal of a face at its first corner."""
    corners = 3 if len(points) in (3, 6) else 4
    normal = np.cross(points[1] - points[0], points[corners - 1] - points[0])
    length = np.linalg.norm(normal)
    if length == 0:
        raise Fault("a face of the section of a bolt has no area")
    return normal / length
