# SPDX-License-Identifier: BSD-2-Clause
"""Cards of supports and loads, and what a step keeps of those of the step before."""
import numpy as np

from squeal.deck.inp.amplitudes import factor_of
from squeal.deck.inp.cards import key_of
from squeal.deck.inp.handlers import PARAMETERS, handles
from squeal.deck.inp.surfaces import face_number
from squeal.deck.journal import TRANSLATED, UNUSED, Fault
from squeal.deck.mesh import EMPTY
from squeal.deck.model import BodyLoad, Value
from squeal.deck.numbers import integer, real

SYMMETRIES = {
    **{"XSYMM": (0, 4, 5), "YSYMM": (1, 3, 5), "ZSYMM": (2, 3, 4)},
    **{"XASYMM": (1, 2, 3), "YASYMM": (0, 2, 4), "ZASYMM": (0, 1, 5)},
    **{"PINNED": (0, 1, 2), "ENCASTRE": (0, 1, 2, 3, 4, 5)},
}


BODY_LOADS = {"GRAV": 4, "CENTRIF": 7, "CENT": 7, "BX": 1, "BY": 1, "BZ": 1}


def _clear_if_new(card, reader, *tables):
    """OP=NEW on the first card of a kind in a step removes what earlier steps have left. Abaqus
    does not accept it on a later card unless the first one has it, and CalculiX ignores it there.
    """
    operation = card.key("OP", "MOD")
    if operation not in ("MOD", "NEW"):
        raise Fault(f"OP={operation} is not supported")
    kind = "DLOAD" if card.keyword == "DSLOAD" else card.keyword
    known = reader.step.operations
    if operation == "NEW" and known.get(kind, "NEW") != "NEW":
        raise Fault(f"OP=NEW must stand on the first *{kind} of the step, too", "OP")
    if operation == "NEW" and kind not in known:
        for table in tables:
            table.clear()
    known.setdefault(kind, operation)


@handles("BOUNDARY", used=("OP", "TYPE", "FIXED", "AMPLITUDE"))
def boundary(card, reader):
    if card.key("TYPE", "DISPLACEMENT") != "DISPLACEMENT":
        raise Fault(f"TYPE={card.value('TYPE')} is not supported", "TYPE")
    supports = reader.model.state.supports
    factor = factor_of(card, reader)
    _clear_if_new(card, reader, supports)
    for line, fields in card.rows():
        nodes = reader.nodes_of(fields[0], line)
        if "FIXED" in card.parameters or _bolts(nodes, reader):
            _lock(nodes, fields, line, reader)
            continue
        components, value = _held(fields, line)
        label = reader.label_of(fields[0], reader.model.node_sets)
        held = Value(factor * value, label, card.source)
        for number in nodes:
            for component in components:
                supports[int(number), component] = held
    reader.journal.mark(card.source, TRANSLATED)


def _bolts(nodes, reader):
    return [bolt for bolt in reader.model.bolts if bolt.node in nodes]


def _lock(nodes, fields, line, reader):
    """Bolts keep the length that they have got: FIXED is supported only for these."""
    bolts = _bolts(nodes, reader)
    if len(bolts) < len(nodes):
        raise Fault(PARAMETERS["FIXED"], "FIXED", line)
    _, value = _held(fields, line)
    if value:
        raise Fault("bolts with a given elongation are not supported", line=line)
    for bolt in bolts:
        bolt.locked = True


def _held(fields, line):
    """Returns components and value of a line of *BOUNDARY."""
    if not 2 <= len(fields) <= 4:
        raise Fault("a line has a node or set, two components and a value", line=line)
    if key_of(fields[1]) in SYMMETRIES:
        return SYMMETRIES[key_of(fields[1])], 0.0
    try:
        first = integer(fields[1], line)
    except Fault:
        known = ", ".join(SYMMETRIES)
        raise Fault(f"'{fields[1]}' is not a component or one of {known}", line=line) from None
    last = integer(fields[2], line) if len(fields) > 2 and fields[2] else first
    if not 1 <= first <= last <= 6:
        what = "temperatures (11)" if first == 11 else f"components {first} to {last}"
        raise Fault(f"{what} are not supported", line=line)
    value = real(fields[3], line) if len(fields) > 3 and fields[3] else 0.0
    return range(first - 1, last), value


@handles("CLOAD", used=("OP", "AMPLITUDE"))
def concentrated_load(card, reader):
    """A force replaces that of earlier steps at its node and component; in one step they add up."""
    if reader.step.frequency:
        reader.journal.mark(card.source, UNUSED, "loads have no effect on free vibrations")
        return
    forces = reader.model.state.forces
    factor = factor_of(card, reader)
    _clear_if_new(card, reader, forces)
    for line, fields in card.rows():
        if len(fields) != 3:
            raise Fault("a line has a node or set, a component and a value", line=line)
        component, value = integer(fields[1], line) - 1, factor * real(fields[2], line)
        if component not in range(6):
            raise Fault("components are 1 to 6", line=line)
        nodes = reader.nodes_of(fields[0], line)
        new = Value(value, reader.label_of(fields[0], reader.model.node_sets), card.source)
        bolts = _bolts(nodes, reader)
        if bolts and component:
            raise Fault("the tension of a bolt is component 1", line=line)
        for bolt in bolts:
            bolt.force = new
        for number in np.setdiff1d(nodes, [bolt.node for bolt in bolts]):
            _add(forces, (int(number), component), new, reader.step)
    reader.journal.mark(card.source, TRANSLATED)


def _add(table, place, new, step):
    """Loads of one step at one place add up; the first one replaces those of earlier steps."""
    before = table[place] if (id(table), place) in step.loaded else None
    if before is not None:
        label = new.label if before.label == new.label else None
        new = Value(before.value + new.value, label, new.source)
    table[place] = new
    step.loaded.add((id(table), place))


@handles("DLOAD", used=("OP", "AMPLITUDE"))
def distributed_load(card, reader):
    if reader.step.frequency:
        reader.journal.mark(card.source, UNUSED, "loads have no effect on free vibrations")
        return
    state = reader.model.state
    factor = factor_of(card, reader)
    _clear_if_new(card, reader, state.pressures, state.body_loads)
    for line, fields in card.rows():
        if len(fields) < 2:
            raise Fault("a line has an element or set, a label and values", line=line)
        elements, label = _loaded_elements(fields[0], line, reader), key_of(fields[1])
        numbers = [real(field, line) if field else 0.0 for field in fields[2:]]
        numbers[:1] = [factor * one for one in numbers[:1]]
        if label in BODY_LOADS:
            load = _body_load(label, elements, numbers, line, card.source)
            _add_body_load(state.body_loads, load, reader.step)
        elif len(label) == 2 and label[0] == "P" and len(numbers) == 1:
            face = face_number(label, "P", line)
            name = reader.label_of(fields[0], reader.model.element_sets)
            pressure = Value(numbers[0], name, card.source)
            for number in elements:
                _add(state.pressures, (int(number), face), pressure, reader.step)
        else:
            raise Fault(f"the load {fields[1]} is not supported", fields[1].upper(), line)
    reader.journal.mark(card.source, TRANSLATED)


def _loaded_elements(word, line, reader):
    """Without an element or set a load acts on all elements, as Abaqus allows."""
    if word:
        return reader.elements_of(word, line)
    blocks = [block.numbers for block in reader.model.blocks if block.shape]
    return np.concatenate([EMPTY, *blocks])


def _add_body_load(loads, new, step):
    """A load replaces those of earlier steps of its direction, element by element; one of another
    direction adds to them (so CalculiX)."""
    for load in loads:
        parallel = load.kind == new.kind and np.allclose(load.direction, new.direction, 0, 1e-12)
        if parallel and id(load) not in step.loaded:
            load.elements = np.setdiff1d(load.elements, new.elements)
    loads.append(new)
    step.loaded.add(id(new))


def _body_load(kind, elements, numbers, line, source):
    count = BODY_LOADS[kind]
    if len(numbers) != count:
        raise Fault(f"{kind} has {count} numbers", kind, line)
    if count == 1:
        return BodyLoad("FORCE", elements, np.eye(3)["XYZ".index(kind[1])], numbers[0], source)
    vector = np.array(numbers[-3:])
    length = np.linalg.norm(vector)
    if length == 0:
        raise Fault(f"the direction of {kind} is zero", kind, line)
    if kind == "GRAV":
        return BodyLoad(kind, elements, vector / length, numbers[0], source)
    if numbers[0] < 0:
        raise Fault("the square of the speed is negative", kind, line)
    # CENT is the density times the square of the speed, CENTRIF the square.
    amount = numbers[0] if kind == "CENT" else np.sqrt(numbers[0])
    return BodyLoad(kind, elements, vector / length, amount, source, np.array(numbers[1:4]))


@handles("DSLOAD", used=("OP", "AMPLITUDE"))
def surface_load(card, reader):
    if reader.step.frequency:
        reader.journal.mark(card.source, UNUSED, "loads have no effect on free vibrations")
        return
    state = reader.model.state
    factor = factor_of(card, reader)
    _clear_if_new(card, reader, state.pressures, state.body_loads)
    for line, fields in card.rows():
        key = reader.set_key(fields[0], reader.model.surfaces)
        surface = reader.model.surfaces.get(key)
        if surface is None or surface.nodes is not None:
            raise Fault(f"there is no surface with faces '{fields[0]}'", line=line)
        if len(fields) != 3 or key_of(fields[1]) != "P":
            raise Fault("only the pressure P is supported", line=line)
        pressure = Value(factor * real(fields[2], line), key, card.source)
        for number, face in zip(surface.elements, surface.faces):
            _add(state.pressures, (int(number), int(face)), pressure, reader.step)
    reader.journal.mark(card.source, TRANSLATED)
