# SPDX-License-Identifier: BSD-2-Clause
"""Cards of a squeal analysis: matter that moves through the mesh, and complex modes."""
import numpy as np

from squeal.deck.inp.dialect import ABAQUS
from squeal.deck.inp.handlers import handles
from squeal.deck.journal import TRANSLATED, Fault
from squeal.deck.model import Motion, Squeal
from squeal.deck.numbers import integer, real

REAL_PARAMETERS = ("FRICTION DAMPING", "NORMALIZATION", "UNSTABLE MODES ONLY")


@handles("MOTION", used=("ROTATION", "TRANSLATION", "TYPE", "DEFINITION"))
def motion(card, reader):
    """TRANSLATION is the default; of a static step, the amounts are velocities."""
    if card.key("TYPE", "VELOCITY") != "VELOCITY":
        raise Fault("only TYPE=VELOCITY is supported", "TYPE")
    if card.key("DEFINITION", "COORDINATES") not in ("COORDINATES", "NODES"):
        raise Fault(f"DEFINITION={card.value('DEFINITION')} is not supported", "DEFINITION")
    rotates = "ROTATION" in card.parameters
    if rotates and "TRANSLATION" in card.parameters:
        raise Fault("ROTATION and TRANSLATION exclude each other")
    read = _rotation if rotates else _translation
    motions = reader.model.motions
    for line, fields in card.rows():
        new = read(card, reader, line, fields)
        again = [one for one in motions if np.array_equal(one.nodes, new.nodes)]
        for one in again:
            if one.source != new.source:
                motions.remove(one)
                reader.journal.choose(f"{new.source}: replaces the motion of {one.source}")
        motions.append(new)


def _rotation(card, reader, line, fields):
    by_nodes = card.key("DEFINITION", "COORDINATES") == "NODES"
    count = 4 if by_nodes else 8
    if len(fields) != count:
        raise Fault(f"a line of ROTATION has {count} fields", line=line)
    nodes = reader.nodes_of(fields[0], line)
    speed = real(fields[1], line)
    if by_nodes:
        points = [reader.model.nodes.at([integer(field, line)])[0] for field in fields[2:]]
        a, b = points
    else:
        values = np.array([real(field, line) for field in fields[2:]])
        a, b = values[:3], values[3:]
    length = np.linalg.norm(b - a)
    if length == 0:
        raise Fault("the two points of the axis coincide", line=line)
    return Motion(np.unique(nodes), speed, card.source, (b - a) / length, a)


def _translation(card, reader, line, fields):
    if not 2 <= len(fields) <= 4:
        raise Fault("a line has a node or set, two components and a velocity", line=line)
    nodes = reader.nodes_of(fields[0], line)
    if any(int(number) in reader.model.frames for number in nodes):
        raise Fault("a translation of nodes with *TRANSFORM is not supported", line=line)
    first = integer(fields[1], line)
    last = integer(fields[2], line) if len(fields) > 2 and fields[2] else first
    if not 1 <= first <= last <= 3:
        raise Fault("components are 1 to 3", line=line)
    velocity = np.zeros(3)
    velocity[first - 1 : last] = real(fields[3], line) if len(fields) > 3 and fields[3] else 0.0
    nodes = np.unique(nodes)
    for one in reader.model.motions:  # another line of this card
        if one.source == card.source and np.array_equal(one.nodes, nodes) and one.axis is None:
            reader.model.motions.remove(one)
            velocity += one.amount
    return Motion(nodes, velocity, card.source)


def request(card, reader):
    """Reads *COMPLEX FREQUENCY of Abaqus. Raises Fault."""
    reader.decide()
    if reader.dialect is not ABAQUS:
        raise Fault("complex modes of a rotor are not translated")
    for name in card.parameters:
        if name not in REAL_PARAMETERS:
            raise Fault("this parameter is not supported", name)
        if name != "FRICTION DAMPING":
            reader.journal.remark(card.source, f"{name} is not used")
    damping = card.key("FRICTION DAMPING", "NO")
    if damping not in ("YES", "NO"):
        raise Fault(f"FRICTION DAMPING={damping} is not supported", "FRICTION DAMPING")
    rows = list(card.rows())
    if len(rows) > 1:
        raise Fault("this card has one line of data", line=rows[1][0])
    count, top = _limits(rows, reader, card)
    reader.step.request = Squeal(card.source, {}, damping == "YES", count, top)
    reader.journal.mark(card.source, TRANSLATED)


def _limits(rows, reader, card):
    """Returns the number of modes and the upper frequency limit, None for those left out."""
    if not rows:
        return None, None
    line, fields = rows[0]
    fields = fields + [""] * 4
    count = integer(fields[0], line) if fields[0] else None
    top = real(fields[2], line) if fields[2] else None
    if fields[1] and real(fields[1], line) > 0:
        reader.journal.remark(
            card.source, "the lower frequency limit is not used: the band is 0 up"
        )
    if any(fields[3:]):
        reader.journal.remark(card.source, "further fields are not used")
    return count, top


def add_request(reader):
    """Adds the request for complex modes of a step that has been read, with the laws of friction
    that hold at its end."""
    request = reader.step.request
    if request is None:
        return
    for key, one in reader.model.interactions.items():
        if one.frictions:
            request.friction[key] = one.frictions[-1]
    reader.model.squeal.append(request)
