# SPDX-License-Identifier: BSD-2-Clause
"""Cards of the mesh: nodes, elements, sets and surfaces."""
import numpy as np

from squeal.deck.cells import HEX8, HEX20, TET4, TET10, WEDGE6, WEDGE15
from squeal.deck.inp.cards import fields_of, key_of
from squeal.deck.inp.handlers import handles
from squeal.deck.journal import UNUSED, USED, Fault
from squeal.deck.model import EMPTY, Block, Surface
from squeal.deck.numbers import integer, is_integer, real

# Kinds of elements that are translated: their solid shape, or their number of nodes.
SOLIDS = {
    **{"C3D4": TET4, "C3D10": TET10, "C3D6": WEDGE6, "C3D15": WEDGE15},
    **{"C3D8": HEX8, "C3D8I": HEX8, "C3D20": HEX20, "C3D20R": HEX20},
}
DISCRETE = {
    **{"SPRINGA": 2, "DASHPOTA": 2, "SPRING1": 1, "MASS": 1, "DCOUP3D": 1},
}
LONGEST = 20_000_000  # of ranges of numbers
ADVICE = {
    "C3D8R": "hourglass control differs in every program; mesh with C3D8 or C3D20",
    "GAPUNI": "gap elements are not supported; use a contact pair",
    "SPRING2": "springs between two components are not supported; use SPRINGA or an equation",
}


@handles("NODE", used=("NSET",), phase=0)
def node(card, reader):
    numbers, places = _fast_nodes(card) or _slow_nodes(card, reader)
    reader.model.nodes.add(numbers, places)
    _define(card, reader, "NSET", reader.model.node_sets, numbers)


def _fast_nodes(card):
    """Returns numbers and coordinates of lines with exactly four plain numbers, otherwise None."""
    texts = [text for _, text in card.data]
    if not texts or any(text.count(",") != 3 for text in texts):
        return None
    try:
        table = np.array(",".join(texts).split(","), dtype=float).reshape(-1, 4)
    except ValueError:
        return None
    with np.errstate(invalid="ignore"):
        numbers = table[:, 0].astype(np.int64)
    plain = np.all(np.isfinite(table)) and np.all(numbers == table[:, 0])
    return (numbers, table[:, 1:]) if plain else None


def _slow_nodes(card, reader):
    numbers, places = [], []
    for line, fields in card.rows():
        numbers.append(integer(fields[0], line))
        coordinates = [real(field, line) if field else 0.0 for field in fields[1:4]]
        places.append(coordinates + [0.0] * (3 - len(coordinates)))
        if len(fields) > 4:
            reader.journal.choose(
                f"{card.source.file}:{line}: the fields after the third coordinate are not used"
            )
    return np.array(numbers, np.int64), np.array(places, float).reshape(-1, 3)


@handles("ELEMENT", used=("TYPE", "ELSET"), phase=0)
def element(card, reader):
    kind = card.key("TYPE")
    if kind not in SOLIDS and kind not in DISCRETE:
        reason = ADVICE.get(kind, "elements of this type are not supported")
        count = sum(1 for _ in card.data)
        refused = reader.journal.refuse(card.source, f"{reason} ({count} lines of data)", kind)
        reader.journal.incomplete |= refused
        _define(card, reader, "ELSET", reader.model.element_sets, EMPTY)
        return
    shape = SOLIDS.get(kind)
    size = shape.size if shape else DISCRETE[kind]
    table = _records(card, size)
    if len(table):
        reader.model.blocks.append(Block(kind, shape, table[:, 0], table[:, 1:], card.source))
    else:
        reader.journal.mark(card.source, UNUSED, "there are no lines of data")
    _define(card, reader, "ELSET", reader.model.element_sets, table[:, 0])


def _records(card, size):
    """Returns the elements of a card, one row each: number and nodes. A record goes on in the next
    line until it has all nodes, with a comma at the end of the line or without."""
    counts, words = [], []
    for _, text in card.data:
        fields = fields_of(text)
        counts.append(len(fields))
        words.extend(fields)
    try:
        flat = np.array(words, dtype=np.int64) if words else np.zeros(0, np.int64)
    except (ValueError, OverflowError):
        flat = np.array([integer(word) for word in words], np.int64)
    starts = np.concatenate([[0], np.cumsum(counts)]).astype(int)
    wanted = np.arange(0, len(flat), size + 1)
    lines = np.searchsorted(starts, wanted)
    broken = starts[np.minimum(lines, len(starts) - 1)] != wanted
    if np.any(broken) or len(flat) % (size + 1):
        at = int(np.flatnonzero(broken)[0]) if np.any(broken) else len(wanted)
        line = card.data[int(np.searchsorted(starts, (at - 1) * (size + 1)))][0]
        raise Fault(f"an element of this type has {size} nodes", line=line)
    return flat.reshape(-1, size + 1)


@handles("NSET", used=("NSET", "GENERATE", "ELSET"), idle=("UNSORTED", "INTERNAL"), phase=0)
def node_set(card, reader):
    if "ELSET" in card.parameters:
        raise Fault("node sets of element sets are not supported")
    _set(card, reader, "NSET", reader.model.node_sets)


@handles("ELSET", used=("ELSET", "GENERATE"), idle=("INTERNAL",), phase=0)
def element_set(card, reader):
    _set(card, reader, "ELSET", reader.model.element_sets)


def _set(card, reader, parameter, sets):
    name = card.require(parameter)
    parts = _generated(card) if "GENERATE" in card.parameters else _listed(card, reader, sets)
    sets.add(key_of(card.parameters[parameter]), name, card.source, parts)


def _generated(card):
    parts = []
    for line, fields in card.rows():
        if not 2 <= len(fields) <= 3:
            raise Fault("a line of GENERATE has first, last and step", line=line)
        first, last = integer(fields[0], line), integer(fields[1], line)
        step = integer(fields[2], line) if len(fields) == 3 and fields[2] else 1
        if step < 1 or last < first:
            raise Fault(f"the range {first}, {last}, {step} is empty", line=line)
        if (last - first) // step > LONGEST:
            raise Fault(f"the range {first}, {last}, {step} is longer than {LONGEST}", line=line)
        parts.append(np.arange(first, last + 1, step, dtype=np.int64))
    return parts


def _listed(card, reader, sets):
    parts, numbers = [], []
    for line, fields in card.rows():
        for word in fields:
            if is_integer(word):
                numbers.append(integer(word, line))
                if word in sets:
                    reader.journal.choose(
                        f"{card.source.file}:{line}: {word} is read as a number, not as a set"
                    )
            elif word:
                parts.append(np.array(numbers, np.int64))
                numbers = []
                key = key_of(word)
                parts.append(key)
                if key not in sets:
                    reader.journal.choose(
                        f"{card.source.file}:{line}: set '{word}' is defined later; it is used as"
                        f" defined there, {card.dialect.name} would take it as empty"
                    )
    return [*parts, np.array(numbers, np.int64)]


def _define(card, reader, parameter, sets, numbers):
    name = card.value(parameter)
    if name is not None:
        sets.add(key_of(card.parameters[parameter]), name, card.source, [numbers])


@handles("SURFACE", used=("NAME", "TYPE"), phase=1)
def surface(card, reader):
    name = card.require("NAME")
    kind = card.key("TYPE", "ELEMENT")
    if kind not in ("ELEMENT", "NODE"):
        raise Fault(f"TYPE={kind} is not supported")
    parts, faces = [], []
    for line, fields in card.rows():
        if kind == "NODE":
            parts.append(reader.nodes_of(fields[0], line))
            continue
        if len(fields) != 2:
            raise Fault("a line has an element or element set and the label of a face", line=line)
        elements = reader.elements_of(fields[0], line)
        parts.append(elements)
        faces.append(np.full(len(elements), face_number(fields[1], "S", line)))
    key = card.key("NAME")
    if key in reader.model.surfaces:
        raise Fault(f"surface '{name}' is defined twice")
    numbers = np.concatenate([EMPTY, *parts])
    if kind == "NODE":
        reader.model.surfaces[key] = Surface(name, card.source, nodes=np.unique(numbers))
    else:
        reader.model.surfaces[key] = Surface(
            name, card.source, None, numbers, np.concatenate([np.zeros(0, int), *faces])
        )


def face_number(label, letter, line):
    """Returns the number of a face from 0, given its label, S3 or P3. Raises Fault."""
    label = label.upper()
    if len(label) != 2 or label[0] != letter or label[1] not in "123456":
        raise Fault(f"'{label}' is not a face: {letter}1 to {letter}6", line=line)
    return int(label[1]) - 1


@handles("NGEN", used=("NSET",), phase=0)
def generated_nodes(card, reader):
    numbers, places = [], []
    for line, fields in card.rows():
        first, last = integer(fields[0], line), integer(fields[1], line)
        step = integer(fields[2], line) if len(fields) > 2 and fields[2] else 1
        if step < 1 or last <= first or (last - first) % step:
            raise Fault(f"{first}, {last}, {step} is not a row of nodes", line=line)
        if (last - first) // step > LONGEST:
            raise Fault(f"the row {first}, {last}, {step} is longer than {LONGEST}", line=line)
        ends = reader.model.nodes.at([first, last])
        between = np.arange(first + step, last, step)
        part = ((between - first) / (last - first))[:, None]
        numbers.append(np.concatenate([[first], between, [last]]))
        places.append(np.concatenate([ends[:1], (1 - part) * ends[0] + part * ends[1], ends[1:]]))
    if numbers:
        reader.model.nodes.add(np.concatenate(numbers), np.concatenate(places))
        _define(card, reader, "NSET", reader.model.node_sets, np.concatenate(numbers))
    reader.journal.mark(card.source, USED)


@handles("INITIAL CONDITIONS", used=("TYPE",))
def initial_conditions(card, reader):
    if card.key("TYPE") != "TEMPERATURE":
        raise Fault(f"TYPE={card.value('TYPE')} is not supported")
    reader.journal.mark(card.source, UNUSED, "no temperatures: a card that gives one is refused")


WITHOUT_EFFECT = {
    "HEADING": "",
    "PHYSICAL CONSTANTS": "temperatures and gravitation between masses are refused",
    "AMPLITUDE": "a load that refers to it is refused",
    "CONTROLS": "this program has its own tolerances",
    "DAMPING": "without effect on *STATIC and *FREQUENCY of CalculiX; damping of the case are the"
    " options -material_<group>_rayleigh_mass and _rayleigh_stiffness",
}


@handles(*WITHOUT_EFFECT, idle=None)
def without_effect(card, reader):
    reader.journal.mark(card.source, UNUSED, WITHOUT_EFFECT[card.keyword])
