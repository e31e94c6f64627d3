# SPDX-License-Identifier: BSD-2-Clause
"""Ties of a case: of two surfaces, or of nodes and a surface.

The nodes of a slave without faces are tied one by one, as CalculiX does: each follows the nearest
point of its master face. These are equations in the case, whose ties need faces on both sides. A
node is tied if its distance from the plane of a triangle of a face is within POSITION TOLERANCE,
and if it lies beside this triangle by no more than the default of that.
"""
import numpy as np

from squeal.deck.case.groups import FACES, clean
from squeal.deck.case.joints import set_equation
from squeal.deck.case.projection import CALCULIX, project
from squeal.deck.case.reached import count_reached
from squeal.deck.journal import TRANSLATED, Fault

# Largest distance of tied nodes without POSITION TOLERANCE in Abaqus' manual, over the edge of the
# master faces.
ABAQUS = 0.05


def add_ties(model, roles, case, journal, faces):
    """Returns for import.md the rows (name, side, tied nodes, free nodes). Moves the nodes of ties
    of nodes onto the master if the deck adjusts them; to be called before coordinates are used."""
    counted = []
    for tie in model.ties:
        try:
            slave, master = model.surfaces[tie.slave], model.surfaces[tie.master]
            if slave.nodes is None:
                _tie_of_faces(tie, slave, master, model, case, journal, faces)
                side, (tied, free) = "faces", count_reached(slave, master, faces, tie.tolerance)
            else:
                tied = _tie_of_nodes(tie, slave, master, model, roles, case, faces)
                side, free = "nodes", len(slave.nodes) - tied
            counted.append((tie.name, side, tied, free))
            journal.remark(tie.source, f"{tied} nodes tied, {free} free")
            if not tied:
                journal.choose(f"{tie.source}: no node of the slave is within reach of the master")
            for source in (tie.source, slave.source, master.source):
                journal.mark(source, TRANSLATED)
        except Fault as fault:
            journal.refuse_fault(tie.source, fault)
    return counted


def _tie_of_faces(tie, slave, master, model, case, journal, faces):
    if tie.tolerance is not None and not tie.tolerance > 0:
        raise Fault(
            f"faces need a positive distance, not {tie.tolerance:g}, or none", "POSITION TOLERANCE"
        )
    path = ("tie", clean(tie.name))
    for key, surface in (("slave", slave), ("master", master)):
        faces.tables(surface.rows)
        case.set((*path, key), case.group(FACES, surface.rows, surface.name), tie.source)
    if tie.tolerance is not None:
        case.set((*path, "tolerance"), tie.tolerance, tie.source)
    if not tie.adjust:
        case.set((*path, "adjust"), False, tie.source)
    other = "" if model.program in ("Abaqus", "Nastran") else ", not node by node as in CalculiX"
    journal.choose(f"{tie.source}: the faces are tied by a mortar method{other}")
    if tie.tolerance is None:
        journal.choose(
            f"{tie.source}: without POSITION TOLERANCE, faces are tied up to a distance of half"
            " their size; the program of the deck ties only nodes within a few percent"
        )


def _tie_of_nodes(tie, slave, master, model, roles, case, faces):
    """Returns the number of tied nodes."""
    nodes = faces.nodes(master.rows)
    if not nodes:
        raise Fault("the master surface has no faces")
    surface = faces.surface(master.rows)
    tolerances = {"CalculiX": CALCULIX * surface.size, "Abaqus": ABAQUS * surface.edge}
    for number in slave.nodes.tolist():
        roles.place(number, 0)
    found = [
        _assign(tie, slave, model, nodes, surface, tolerance)
        for program, tolerance in tolerances.items()
        if model.program not in tolerances or program == model.program
    ]
    if any(set(one) != set(found[0]) for one in found):
        raise Fault(
            "the default tolerances of Abaqus and CalculiX tie different nodes; choose --dialect"
            " abaqus or calculix, or give a POSITION TOLERANCE"
        )
    for number, face in found[0].items():
        weights, place = project(model.nodes.at([number])[0], surface.faces[face])
        if tie.adjust:
            model.nodes.move(number, place)
        _follow(tie, number, nodes[face], weights, roles, case)
    return len(found[0])


def _assign(tie, slave, model, nodes, surface, beside):
    """Returns the face of each node that is tied."""
    bound = beside if tie.tolerance is None else tie.tolerance
    owners, _ = surface.assign(model.nodes.at(slave.nodes), beside, bound)
    return {
        number: face
        for number, face in zip(slave.nodes.tolist(), owners.tolist())
        if face >= 0 and number not in nodes[face]
    }


def _follow(tie, number, nodes, weights, roles, case):
    """u = Σ N u of the nodes of the face, in global axes."""
    kept = np.abs(weights) > 1e-12
    for component, axis in enumerate("xyz"):
        terms = [(roles.name(number), component, 1.0)]
        for master, weight in zip(nodes[kept].tolist(), weights[kept]):
            terms.append((roles.name(master), component, -weight))
        set_equation(case, f"{clean(tie.name)}_{number}_{axis}", terms, tie.source)
