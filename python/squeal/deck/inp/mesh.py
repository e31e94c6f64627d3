# SPDX-License-Identifier: BSD-2-Clause
"""Cards of the mesh: nodes, elements, sets and surfaces."""
import numpy as np

from squeal.deck.axes import orthonormal
from squeal.deck.inp.cards import key_of
from squeal.deck.inp.dialect import ABAQUS
from squeal.deck.inp.handlers import handles
from squeal.deck.inp.types import ADVICE, BECOMES, DISCRETE, SOLIDS
from squeal.deck.journal import UNUSED, Fault, place_of
from squeal.deck.mesh import EMPTY, Block
from squeal.deck.numbers import LONGEST, integer, is_integer, real, table


@handles("NODE", used=("NSET", "SYSTEM", "INPUT"), phase=0)
def node(card, reader):
    numbers, places = _fast_nodes(card) or _slow_nodes(card, reader)
    kind = card.key("SYSTEM", "R")
    if kind not in ("R", "C", "S"):
        raise Fault(f"SYSTEM={kind} is not supported", "SYSTEM")
    numbers = reader.scope.node_numbers.shifted(numbers)
    reader.scope.nodes.add(numbers, in_axes(_cartesian(places, kind), reader.scope.system))
    define(card, reader, "NSET", reader.model.node_sets, numbers)


def _cartesian(places, kind):
    """Returns coordinates of cylindrical (r, angle, z) or spherical ones (r, longitude, latitude),
    with angles in degrees."""
    if kind == "R":
        return places
    r, angle = places[:, 0], np.radians(places[:, 1])
    if kind == "C":
        return np.column_stack([r * np.cos(angle), r * np.sin(angle), places[:, 2]])
    latitude = np.radians(places[:, 2])
    across = r * np.cos(latitude)
    return np.column_stack([across * np.cos(angle), across * np.sin(angle), r * np.sin(latitude)])


def in_axes(places, system):
    """Returns points given in the axes of *SYSTEM, if there is one, in those of the part."""
    if system is None:
        return places
    origin, axes = system
    return origin + places @ axes


@handles("SYSTEM", phase=0, lines=2)
def system(card, reader):
    """Origin and a point on the x axis, then one in the plane of x and y; without data the axes of
    the part again. With two points the axes are turned about z."""
    rows = list(card.rows())
    if not rows:
        reader.scope.system = None
        return
    line, fields = rows[0]
    numbers = [real(field, line) if field else 0.0 for field in fields]
    if len(numbers) not in (3, 6) or len(rows) == 2 and len(numbers) != 6:
        raise Fault("the first line has the origin and a point on the axis x", line=line)
    origin, x, plane = np.array(numbers[:3]), np.array([1.0, 0, 0]), np.array([0, 1.0, 0])
    if len(numbers) == 6:
        x = np.array(numbers[3:]) - origin
        plane = np.cross([0, 0, 1.0], x)
    if len(rows) == 2:
        line, fields = rows[1]
        if len(fields) != 3:
            raise Fault("the second line has a point in the plane of x and y", line=line)
        plane = np.array([real(field, line) for field in fields]) - origin
    reader.scope.system = origin, orthonormal(x, plane)


def _fast_nodes(card):
    """Returns numbers and coordinates of lines with exactly four plain numbers, otherwise None."""
    texts = [text for _, text in card.data]
    if not texts or any(text.count(",") != 3 for text in texts):
        return None
    try:
        values = table(",".join(texts).split(","), float).reshape(-1, 4)
    except ValueError:
        return None
    with np.errstate(invalid="ignore"):
        numbers = values[:, 0].astype(np.int64)
    plain = np.all(np.isfinite(values)) and np.all(numbers == values[:, 0])
    return (numbers, values[:, 1:]) if plain else None


def _slow_nodes(card, reader):
    numbers, places = [], []
    for line, fields in card.rows():
        numbers.append(integer(fields[0], line))
        coordinates = [real(field, line) if field else 0.0 for field in fields[1:4]]
        places.append(coordinates + [0.0] * (3 - len(coordinates)))
        if len(fields) > 4:
            reader.journal.choose(
                f"{place_of(card.source, line)}: the fields after the third coordinate are not used"
            )
    return np.array(numbers, np.int64), np.array(places, float).reshape(-1, 3)


@handles("ELEMENT", used=("TYPE", "ELSET", "INPUT"), phase=0)
def element(card, reader):
    kind = card.key("TYPE")
    if kind in BECOMES and (kind != "C3D8R" or reader.dialect is ABAQUS):
        written, (kind, difference) = kind, BECOMES[kind]
        reader.journal.choose(f"{written}: {difference}")
    if kind not in SOLIDS and kind not in DISCRETE:
        reason = ADVICE.get(kind, "elements of this type are not supported")
        count = sum(1 for _ in card.data)
        refused = reader.journal.refuse(card.source, f"{reason} ({count} lines of data)", kind)
        reader.journal.incomplete |= refused
        define(card, reader, "ELSET", reader.model.element_sets, EMPTY)
        return
    shape = SOLIDS.get(kind)
    size = shape.size if shape else DISCRETE[kind]
    rows = _records(card, size, reader)
    if len(rows):
        reader.model.blocks.append(Block(kind, shape, rows[:, 0], rows[:, 1:], card.source))
    else:
        reader.journal.mark(card.source, UNUSED, "there are no lines of data")
    define(card, reader, "ELSET", reader.model.element_sets, rows[:, 0])


def _records(card, size, reader):
    """Returns the elements of a card, one row each: number and nodes. A record goes on in the next
    line until it has all nodes, with a comma at the end of the line or without."""
    counts, words = _words(card)
    try:
        flat = table(words, np.int64) if words else np.zeros(0, np.int64)
        of_nodes = np.arange(len(flat)) % (size + 1) != 0
        flat[of_nodes] = reader.scope.node_numbers.shifted(flat[of_nodes])
    except (ValueError, OverflowError):
        flat = [
            reader.node_number(word) if at % (size + 1) else integer(word)
            for at, word in enumerate(word.strip() for word in words)
        ]
        flat = np.array(flat, np.int64)
    flat[:: size + 1] = reader.scope.element_numbers.shifted(flat[:: size + 1])
    starts = np.concatenate([[0], np.cumsum(counts)]).astype(int)
    wanted = np.arange(0, len(flat), size + 1)
    lines = np.searchsorted(starts, wanted)
    broken = starts[np.minimum(lines, len(starts) - 1)] != wanted
    if np.any(broken) or len(flat) % (size + 1):
        at = int(np.flatnonzero(broken)[0]) if np.any(broken) else len(wanted)
        line = card.data[int(np.searchsorted(starts, (at - 1) * (size + 1)))][0]
        raise Fault(f"an element of this type has {size} nodes", line=line)
    return flat.reshape(-1, size + 1)


def _words(card):
    """Returns the numbers of fields of the lines, and all fields, which may have blanks around
    them. Faster than fields_of(), for millions of lines."""
    texts = [text[:-1] if text[-1] == "," else text for _, text in card.data]
    whole = ",".join(texts)
    if '"' in whole:
        rows = [fields for _, fields in card.rows()]
        return [len(fields) for fields in rows], [word for fields in rows for word in fields]
    return [text.count(",") + 1 for text in texts], whole.split(",") if texts else []


@handles(
    "NSET",
    used=("NSET", "GENERATE", "ELSET", "INSTANCE", "INPUT", "UNSORTED"),
    idle=("INTERNAL",),
    phase=0,
)
def node_set(card, reader):
    scope = reader.scope_of(card)
    sets = reader.model.node_sets
    if "ELSET" in card.parameters:
        key = scope.prefix + card.key("ELSET")
        if card.data:
            raise Fault("a node set of an element set has no lines of data", line=card.data[0][0])
        if "UNSORTED" in card.parameters:
            reader.journal.remark(card.source, "UNSORTED is not used: the nodes are ascending")
        define(card, reader, "NSET", sets, lambda: reader.nodes_of_element_set(key))
        return
    _set(card, reader, "NSET", sets, scope, scope.node_numbers)


@handles("ELSET", used=("ELSET", "GENERATE", "INSTANCE", "INPUT"), idle=("INTERNAL",), phase=0)
def element_set(card, reader):
    scope = reader.scope_of(card)
    _set(card, reader, "ELSET", reader.model.element_sets, scope, scope.element_numbers)


def _set(card, reader, parameter, sets, scope, own):
    """`scope`: that of the names in the lines, `own`: its numbers. Equations, multi-point
    constraints and *NFILL combine the nodes of two sets in their order."""
    key, spelled = reader.defined(card, parameter)
    if "GENERATE" in card.parameters:
        parts = [own.shifted(numbers, line) for line, numbers in _generated(card)]
    else:
        parts = _listed(card, reader, sets, scope, own)
    sets.add(key, spelled, card.source, parts, "UNSORTED" in card.parameters)


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
        parts.append((line, np.arange(first, last + 1, step, dtype=np.int64)))
    return parts


def _listed(card, reader, sets, scope, own):
    plain = _plain_numbers(card)
    if plain is not None and not any(is_integer(key[len(scope.prefix) :]) for key in sets):
        return [own.shifted(plain)]
    parts, numbers = [], []
    for line, fields in card.rows():
        for word in fields:
            if is_integer(word):
                numbers.append(own.one(integer(word, line), line))
                if scope.prefix + word in sets:
                    reader.journal.choose(
                        f"{place_of(card.source, line)}: {word} is read as a number, not as a set"
                    )
            elif word:
                parts.append(np.array(numbers, np.int64))
                numbers = []
                parts.append(_part(word, line, card, reader, sets, scope))
    return [*parts, np.array(numbers, np.int64)]


def _plain_numbers(card):
    """Returns the numbers of lines that have nothing else, otherwise None."""
    words = ",".join(text.rstrip(",") for _, text in card.data).split(",")
    try:
        return table(words, np.int64)
    except (ValueError, OverflowError):
        return None


def _part(word, line, card, reader, sets, scope):
    """Returns a member of a set that is not a plain number: the number of something of an instance,
    or the key of a set, which may be defined later."""
    key = reader.key_in(scope, key_of(word))
    if key not in sets:
        number = reader.number_of_instance(word, sets)
        if number is not None:
            return np.array([number], np.int64)
        if not card.dialect.short_words:
            reader.journal.choose(
                f"{place_of(card.source, line)}: set '{word}' is defined later; it is used as"
                " defined there, CalculiX would take it as empty"
            )
    return key


def define(card, reader, parameter, sets, numbers):
    """Defines the set of a parameter, if that is given; its `numbers` may be a function."""
    if parameter in card.parameters:
        sets.add(*reader.defined(card, parameter), card.source, [numbers])


@handles("INITIAL CONDITIONS", used=("TYPE",), phase=1)
def initial_conditions(card, reader):
    """Temperatures at the start, at which materials have their constants."""
    if card.key("TYPE") != "TEMPERATURE":
        raise Fault(f"TYPE={card.value('TYPE')} is not supported")
    for line, fields in card.rows():
        if len(fields) < 2:
            raise Fault("a line has a node or node set and a temperature", line=line)
        nodes, value = reader.nodes_of(fields[0], line), real(fields[1], line)
        reader.model.temperatures.append((nodes, value, card.source))


WITHOUT_EFFECT = {
    "HEADING": "",
    "PHYSICAL CONSTANTS": "temperatures and gravitation between masses are refused",
    "CONTROLS": "this program has its own tolerances",
    "SECTION CONTROLS": "hourglass control and the like of the other program",
}


@handles(*WITHOUT_EFFECT, idle=None)
def without_effect(card, reader):
    reader.journal.mark(card.source, UNUSED, WITHOUT_EFFECT[card.keyword])
