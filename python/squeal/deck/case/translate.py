# SPDX-License-Identifier: BSD-2-Clause
"""Translates a model into a case."""
import numpy as np

from squeal.deck.case.bodies import add_bodies
from squeal.deck.case.bolts import add_bolts
from squeal.deck.case.checks import check_elements, check_mesh
from squeal.deck.case.contacts import add_contacts
from squeal.deck.case.faces import Faces
from squeal.deck.case.frictions import set_friction
from squeal.deck.case.groups import Case
from squeal.deck.case.joints import add_joints
from squeal.deck.case.roles import Roles
from squeal.deck.case.state import add_forces, add_pressures, add_supports
from squeal.deck.case.ties import add_ties
from squeal.deck.journal import UNUSED, USED


def translate(model, journal):
    """Returns the case of a model, or None without a complete mesh. Refuses in the journal what the
    program does not have."""
    if not check_mesh(model, journal):
        return None
    check_elements(model, journal)
    case = Case()
    case.set(("mesh", "file"), "mesh.msh")
    faces = Faces(model)
    add_bodies(model, case, journal)
    roles = Roles(model, case, journal)
    case.ties = add_ties(model, roles, case, journal, faces)
    frictions, undetermined = add_contacts(model, case, journal, faces)
    add_joints(model, roles, case, journal, faces)
    add_bolts(model, case, journal, faces)
    add_supports(model, roles, case, journal)
    add_forces(model, roles, case, journal)
    add_pressures(model, case, journal, faces)
    case.nodes = roles.cell_nodes
    _name_idle_nodes(model, roles, journal)
    _name_idle_cards(model, journal)
    if model.prestress:
        more = "" if model.program != "CalculiX" else "; CalculiX also includes its change of shape"
        journal.choose(
            f"{model.frequency}: the stress of the static step changes the stiffness{more}"
        )
        case.set(("elasticity", "prestress"), True, model.frequency)
    if model.state.gravity is not None:
        case.set(("load", "gravity"), *model.state.gravity)
    set_friction(model, case, journal, frictions, undetermined)
    if frictions is None and model.top:
        case.set(("flutter", "band"), model.top, model.frequency)
    return case


def _name_idle_nodes(model, roles, journal):
    others = np.setdiff1d(model.nodes.numbers, roles.cell_nodes)
    others = np.setdiff1d(others, [bolt.node for bolt in model.bolts])
    idle = [number for number in others.tolist() if not roles.is_used(number)]
    if idle:
        journal.choose(
            f"nodes left out, since no solid element or joint has them: {len(idle)}, such as node"
            f" {model.node_label(idle[0])}"
        )


def _name_idle_cards(model, journal):
    """Materials, orientations and axes that nothing in the case refers to."""
    sections = model.sections
    for key, material in model.materials.items():
        if not any(section.material == key for section in sections):
            for source in (material.source, material.elastic, material.density_source):
                if source is not None:
                    journal.mark(source, UNUSED, "no section uses this material")
    for key, frame in model.orientations.items():
        coupled = any(one.frame is frame for one in model.rigid)
        if not coupled and not any(section.orientation == key for section in sections):
            journal.mark(frame.source, UNUSED, "nothing uses this orientation")
    for sources, remark in (
        ([one.source for one in model.amplitudes.values()], "no load refers to this amplitude"),
        ([one[2] for one in model.temperatures], "no constants of a material depend on it"),
        (
            [frame.source for frame in model.frames.values()],
            "no support, force or equation has these axes",
        ),
    ):
        for source in sources:
            if journal.entries[source].status == USED:
                journal.mark(source, UNUSED, remark)
