# SPDX-License-Identifier: BSD-2-Clause
"""Which bodies of a case move, how fast, and about which axis.

The deck gives the motion of matter at nodes. Without that, a prescribed turn or shift of a part
that rubs, such as the turn of a hub, stands for its motion.
"""
from dataclasses import dataclass

import numpy as np

from squeal.deck.case.groups import clean
from squeal.deck.journal import TRANSLATED, Fault
from squeal.deck.mesh import EMPTY
from squeal.deck.model import Motion

PRECISION = 0.02  # of a small turn that is taken as a rigid motion: finite turns are not linear
EXACT = 1e-4  # of a finite turn, whose displacements are written with few digits


@dataclass
class Moving:
    """A body that moves. `known`: the amount is a velocity."""

    motion: Motion
    known: bool


class Bodies:
    """Bodies of a case with their nodes. `faces`: the object that looks faces of elements up."""

    def __init__(self, model, case, faces):
        self.model, self.faces = model, faces
        self.names = list(case.bodies)
        self.cells = list(case.bodies.values())
        self.nodes = [model.nodes_of_elements(cells) for cells in self.cells]

    def of_elements(self, elements):
        """Returns the numbers of the bodies that have some of these elements."""
        return {at for at, cells in enumerate(self.cells) if np.any(np.isin(elements, cells))}

    def of_nodes(self, nodes):
        return {at for at, own in enumerate(self.nodes) if np.any(np.isin(nodes, own))}

    def joined(self):
        """Returns for each body the set of the bodies that share nodes or are tied or coupled with
        it, directly or through others."""
        links = [{at} for at in range(len(self.names))]
        for at, nodes in enumerate(self.nodes):
            links[at] |= {other for other in self.of_nodes(nodes)}
        for group in self._joints():
            for at in group:
                links[at] |= group
        found = []
        for start in range(len(links)):
            reached, open_ = {start}, [start]
            while open_:
                new = links[open_.pop()] - reached
                reached |= new
                open_ += new
            found.append(reached)
        return found

    def _joints(self):
        surfaces = self.model.surfaces
        for tie in self.model.ties:
            group = set()
            for key in (tie.slave, tie.master):
                surface = surfaces[key]
                group |= (
                    self.of_elements(surface.elements)
                    if surface.nodes is None
                    else self.of_nodes(surface.nodes)
                )
            yield group
        for rigid in self.model.rigid:
            yield self.of_rigid(rigid)

    def of_rigid(self, rigid):
        """Returns the bodies of a rigid body or of a coupling; none if its faces do not exist, for
        which the coupling is refused."""
        if rigid.surface is None:
            return self.of_nodes(rigid.nodes)
        try:
            return self.of_nodes(self.faces.nodes_of(self.model.surfaces[rigid.surface]))
        except Fault:
            return set()


def moving_bodies(model, contacts, bodies, case, journal):
    """Returns number of body -> Moving, and sets the options of the motions. Removes prescribed
    displacements that stand for a motion from the supports of the model. `contacts`: those whose
    interaction and faces exist."""
    if model.motions:
        moving = _given(model, contacts, bodies, journal)
    else:
        moving = _turned(model, contacts, bodies, journal) if model.squeal else {}
    for at, one in moving.items():
        _set_motion(case, bodies.names[at], one, model, journal)
    return moving


def _rubbing(model, contacts, bodies):
    """Returns the bodies with a contact that has friction."""
    found = set()
    for contact in contacts:
        if model.interactions[contact.interaction].frictions:
            for key in (contact.slave, contact.master):
                found |= bodies.of_elements(model.surfaces[key].elements)
    return found


def _given(model, contacts, bodies, journal):
    moving = {}
    surfaces = [model.surfaces[key] for one in contacts for key in (one.slave, one.master)]
    contact_nodes = [
        (bodies.of_elements(one.elements), bodies.faces.nodes_of(one)) for one in surfaces
    ]
    for motion in model.motions:
        try:
            _add_given(motion, bodies, contact_nodes, moving, journal)
            journal.mark(motion.source, TRANSLATED)
        except Fault as fault:
            journal.refuse_fault(motion.source, fault)
    return moving


def _add_given(motion, bodies, contact_nodes, moving, journal):
    """A body moves if all its nodes do, or all nodes of one of its contact surfaces: the velocity
    of other matter has no effect on friction."""
    chosen = set()
    for at, nodes in enumerate(bodies.nodes):
        inside = int(np.isin(nodes, motion.nodes).sum())
        slides = any(
            at in owners and len(own) and np.all(np.isin(own, motion.nodes))
            for owners, own in contact_nodes
        )
        if inside == len(nodes):
            chosen.add(at)
        elif slides:
            chosen.add(at)
            journal.choose(
                f"{motion.source}: the set has {inside} of {len(nodes)} nodes of body"
                f" '{bodies.names[at]}', among them a contact surface; the whole body moves"
            )
    if not chosen:
        raise Fault("the set holds neither all nodes of a body nor those of a contact surface")
    for at in chosen:
        if at in moving:
            raise Fault(f"body '{bodies.names[at]}' has two motions")
        moving[at] = Moving(motion, motion.known)


def _turned(model, contacts, bodies, journal):
    """Fits the motion of a rigid body to prescribed displacements of each part that rubs. A part
    that they press onto its contacts does not move. Refuses those of a part that fit no rigid
    motion, unless another part moves."""
    moving, unfit = {}, []
    joined = bodies.joined()
    for at in sorted(_rubbing(model, contacts, bodies)):
        group = joined[at]
        if at in moving:
            continue
        nodes = np.unique(np.concatenate([bodies.nodes[one] for one in group]))
        places = list(_held(model, nodes, group, bodies))
        if not any(value.value for _, value in places):
            continue
        source = next(value.source for _, value in places if value.value)
        try:
            motion = _fit(model, places, source)
        except Fault as fault:
            unfit.append((source, fault))
            continue
        if not _slides(motion, model, contacts, group, bodies):
            continue
        moved = [place for place, value in places if value.value]
        for place in moved:
            held = model.state.supports[place]
            model.state.supports[place] = type(held)(0.0, held.label, held.source)
        names = ", ".join(f"'{bodies.names[one]}'" for one in sorted(group))
        journal.choose(
            f"{source}: the prescribed {'turn' if motion.axis is not None else 'shift'} of {names}"
            " is a steady motion; the nodes are held where they are"
        )
        moving.update({one: Moving(motion, False) for one in group})
    for source, fault in unfit if not moving else ():
        journal.refuse_fault(source, fault)
    return moving


def _slides(motion, model, contacts, group, bodies):
    """Returns whether a motion is along the contact faces of a part rather than across them."""
    along = across = 0.0
    for contact in contacts:
        for key in (contact.slave, contact.master):
            surface = model.surfaces[key]
            if not bodies.of_elements(surface.elements) & group:
                continue
            for _, table in bodies.faces.tables(surface.rows):
                corners = [model.nodes.at(table[:, at]) for at in range(3)]
                normals = np.cross(corners[1] - corners[0], corners[2] - corners[0])
                velocities = np.broadcast_to(motion.amount, normals.shape)
                if motion.axis is not None:
                    velocities = np.cross(motion.axis, sum(corners) / 3 - motion.origin)
                across += np.abs(np.einsum("fi,fi->f", velocities, normals)).sum()
                along += np.linalg.norm(np.cross(velocities, normals), axis=1).sum()
    return along > across


def _held(model, nodes, group, bodies):
    """Yields place and value of the supports of a part: of its nodes, and of the reference nodes of
    its couplings."""
    references = {}
    for rigid in model.rigid:
        if bodies.of_rigid(rigid) & group:
            references[rigid.reference] = rigid
            if rigid.rotation is not None:
                references[rigid.rotation] = rigid
    inside = set(nodes.tolist())
    for place, value in model.state.supports.items():
        if place[0] in inside or place[0] in references:
            yield place, value


def _fit(model, places, source):
    """Returns the rigid motion whose displacements at these places are closest to the prescribed
    ones: a finite turn where they are known as whole vectors, otherwise a small one. Raises Fault
    if they are not those of a rigid motion."""
    finite = _finite_turn(model, places, source)
    return finite or _small_motion(model, places, source)


def _finite_turn(model, places, source):
    """Returns the turn that takes each node to its prescribed place, to round-off, or None.

    Source of the method: Kabsch, Acta Cryst. A32 (1976) 922."""
    known = {}
    for (number, component), value in places:
        if component < 3 and number not in model.frames and model.nodes.has([number])[0]:
            known.setdefault(number, {})[component] = value.value
    whole = {number: parts for number, parts in known.items() if len(parts) == 3}
    if len(whole) < 3 or sum(map(len, known.values())) < len(places):
        return None
    before = model.nodes.at(list(whole))
    moves = np.array([[parts[at] for at in range(3)] for parts in whole.values()])
    centre, shift = before.mean(axis=0), moves.mean(axis=0)
    arms = before - centre
    left, _, right = np.linalg.svd(arms.T @ (arms + moves - shift))
    sense = np.sign(np.linalg.det(left) * np.linalg.det(right))
    turn = right.T @ np.diag([1.0, 1.0, sense]) @ left.T
    error = np.abs(arms @ turn.T - arms - moves + shift).max()
    twice = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    if error > EXACT * np.abs(moves).max() or np.linalg.norm(twice) < 1e-9:
        return None
    axis = twice / np.linalg.norm(twice)
    if abs(np.dot(shift, axis)) > PRECISION * np.abs(moves).max():
        return None
    # The axis goes through the points that stay: (turn - 1) (x - centre) = -shift.
    origin = centre - np.linalg.lstsq(turn - np.eye(3), shift, rcond=1e-9)[0]
    size = np.abs(before).max()
    return Motion(EMPTY, 1.0, source, _rounded(axis, 1.0), _rounded(origin, size))


def _small_motion(model, places, source):
    rotations = {one.rotation: one.reference for one in model.rigid if one.rotation is not None}
    rows, values = [], []
    for (number, component), value in places:
        turns = component > 2 or number in rotations
        point = model.nodes.at([rotations.get(number, number)])[0]
        frame = model.frames.get(number)
        axes = np.eye(3) if frame is None else frame.axes_at(point)
        direction = axes[component % 3]
        arm = np.cross(point, direction)
        rows.append([*np.zeros(3), *direction] if turns else [*direction, *arm])
        values.append(value.value)
    rows, values = np.array(rows), np.array(values)
    size = max(np.abs(rows[:, 3:]).max(), 1e-300)
    rows[:, 3:] /= size  # shifts and turns of one order
    answer = np.linalg.lstsq(rows, values, rcond=1e-10)[0]
    error = np.abs(rows @ answer - values).max()
    if error > PRECISION * np.abs(values).max():
        raise Fault(
            "the prescribed displacements are not those of a rigid turn or shift; state the motion"
            " of the sliding body by *MOTION"
        )
    shift, turn = answer[:3], answer[3:] / size
    if np.linalg.norm(turn) * size <= PRECISION * np.linalg.norm(shift):
        return Motion(EMPTY, _rounded(shift / np.linalg.norm(shift), 1.0), source)
    speed = np.linalg.norm(turn)
    # Points of the axis do not move across it: shift + turn × origin is along the axis.
    origin = np.cross(turn, shift) / speed**2
    return Motion(EMPTY, 1.0, source, _rounded(turn / speed, 1.0), _rounded(origin, size))


def _rounded(vector, size):
    """Returns a vector of a least-squares fit without its round-off."""
    return np.round(vector, 12 - int(np.ceil(np.log10(size))))


def _set_motion(case, body, moving, model, journal):
    path, motion = ("motion", clean(body)), moving.motion
    factor = 1.0 if moving.known else model.speed or 1.0
    if motion.axis is None:
        case.set((*path, "velocity"), factor * motion.amount, motion.source)
        return
    case.set((*path, "speed"), factor * motion.amount, motion.source)
    case.set((*path, "axis"), motion.axis, motion.source)
    case.set((*path, "origin"), motion.origin, motion.source)
