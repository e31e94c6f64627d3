# SPDX-License-Identifier: BSD-2-Clause
"""Cards of materials, sections and axes."""
import numpy as np

from squeal.deck.axes import Frame
from squeal.deck.inp.dialect import ABAQUS
from squeal.deck.inp.handlers import handles
from squeal.deck.journal import UNUSED, Fault
from squeal.deck.model import Material, Section
from squeal.deck.numbers import integer, real

# Law, number of constants and lines of one temperature.
LAWS = {
    **{"ISO": ("isotropic", 2, 1), "ISOTROPIC": ("isotropic", 2, 1)},
    **{"ORTHO": ("orthotropic", 9, 2), "ORTHOTROPIC": ("orthotropic", 9, 2)},
    **{"ANISO": ("anisotropic", 21, 3), "ANISOTROPIC": ("anisotropic", 21, 3)},
    "ENGINEERINGCONSTANTS": ("engineering", 9, 2),
}
WITHOUT_EFFECT = (
    "without effect on *STATIC and *FREQUENCY of CalculiX; damping of the case are the options"
    " -material_<group>_rayleigh_mass and _rayleigh_stiffness"
)
OTHER_LAWS = {
    **{"PLASTIC": "plasticity", "CYCLIC HARDENING": "plasticity", "CREEP": "creep"},
    **{"HYPERELASTIC": "hyperelasticity", "HYPERFOAM": "hyperelasticity"},
    **{"DEFORMATION PLASTICITY": "plasticity", "MOHR COULOMB": "plasticity"},
    **{"USER MATERIAL": "a law of the user", "DEPVAR": "a law of the user"},
}


@handles("MATERIAL", used=("NAME",), lines=0)
def material(card, reader):
    name = card.require("NAME")
    key = card.key("NAME")
    if key in reader.model.materials:
        raise Fault(f"material '{name}' is defined twice")
    reader.material = reader.model.materials[key] = Material(name, card.source)


def _material(reader):
    if reader.material is None:
        raise Fault("this card belongs after *MATERIAL")
    return reader.material


@handles("ELASTIC", used=("TYPE",))
def elastic(card, reader):
    one = _material(reader)
    kind = card.key("TYPE", "ISO")
    if kind not in LAWS:
        raise Fault(f"TYPE={kind} is not supported")
    law, count, lines = LAWS[kind]
    if one.law:
        raise Fault(f"material '{one.name}' has two laws")
    one.elastic = card.source
    table = _table(card, count, lines, f"TYPE={kind}")
    one.constants = _at_temperature(card, table, count, reader)
    one.law = law


def _table(card, count, lines, name):
    """Returns rows of constants and their temperature, if the deck gives one; each row may take
    several lines."""
    rows = list(card.rows())
    table = []
    for first in range(0, max(len(rows), 1), lines):
        fields = [field for _, row in rows[first : first + lines] for field in row]
        if len(fields) not in (count, count + 1):
            ends = "1 line" if lines == 1 else f"{lines} lines"
            constants = "1 constant" if count == 1 else f"{count} constants"
            raise Fault(f"{name} has {constants} and a temperature on {ends}")
        table.append([real(field, rows[first][0]) for field in fields])
    return table


def _at_temperature(card, table, count, reader):
    """Returns the constants at the temperature of the start: between those of a table they change
    linearly, beyond its ends they stay constant."""
    if len(table) == 1:
        if len(table[0]) > count:
            # A decimal comma would read as a temperature, too.
            constants = ", ".join(f"{one:g}" for one in table[0][:count])
            reader.journal.choose(
                f"{card.source}: {constants} at the temperature {table[0][count]:g}, which is not"
                " used"
            )
        return tuple(table[0][:count])
    values = np.array([row + [0.0] * (count + 1 - len(row)) for row in table])
    temperatures = values[:, count]
    if np.any(np.diff(temperatures) <= 0):
        raise Fault("the temperatures of a table have to ascend")
    at = reader.temperature()
    reader.journal.choose(
        f"{card.source}: the constants are those at the temperature {at:g} of the start"
    )
    return tuple(float(np.interp(at, temperatures, column)) for column in values.T[:count])


@handles("DENSITY")
def density(card, reader):
    one = _material(reader)
    if not card.data:
        raise Fault("there is no line of data")
    if one.density_source:
        raise Fault(f"material '{one.name}' has two densities")
    (one.density,) = _at_temperature(card, _table(card, 1, 1, "a density"), 1, reader)
    one.density_source = card.source


@handles("DAMPING", used=("ALPHA", "BETA", "STRUCTURAL"), lines=0)
def damping(card, reader):
    """Rayleigh damping of the material: C = ALPHA M + BETA K."""
    reader.decide()
    if reader.dialect is not ABAQUS:
        reader.journal.mark(card.source, UNUSED, WITHOUT_EFFECT)
        return
    one = _material(reader)
    if real(card.value("STRUCTURAL") or "0") != 0:
        raise Fault(
            "structural damping needs a frequency; set -material_<group>_loss_factor and"
            " _loss_frequency in the case",
            "STRUCTURAL",
        )
    if one.damping_source:
        raise Fault(f"material '{one.name}' has two laws of damping")
    one.damping = tuple(real(card.value(name) or "0") for name in ("ALPHA", "BETA"))
    one.damping_source = card.source


@handles("EXPANSION", "CONDUCTIVITY", "SPECIFIC HEAT", "ELECTRICAL CONDUCTIVITY", idle=None)
def thermal(card, reader):
    reader.journal.mark(card.source, UNUSED, "no temperatures: a card that gives one is refused")


@handles(*OTHER_LAWS, idle=None)
def other_law(card, reader):
    """Recorded with the material, and refused if a section uses that."""
    reason = f"{OTHER_LAWS[card.keyword]} is not supported"
    _material(reader).refusals.append((card.source, reason))
    reader.journal.mark(card.source, UNUSED)


@handles("SOLID SECTION", used=("ELSET", "MATERIAL", "ORIENTATION"), idle=("CONTROLS",), lines=1)
def solid_section(card, reader):
    sets = reader.model.element_sets
    label = reader.key(card, "ELSET", sets)
    orientation = None
    if "ORIENTATION" in card.parameters:
        orientation = reader.key(card, "ORIENTATION", reader.model.orientations)
    reader.model.sections.append(
        Section(sets.members(label), label, card.key("MATERIAL"), orientation, card.source)
    )
    if card.data:
        reader.journal.remark(card.source, "the line of data has no effect on solid cells")


def _frame(card, name, cylindrical, scope):
    """Returns axes, which turn with their part, and the lines that follow."""
    rows = list(card.rows())
    if not rows:
        raise Fault("there is no line of data")
    line, fields = rows[0]
    if len(fields) not in (6, 9):
        raise Fault("the axes need the coordinates of two points", line=line)
    numbers = np.array([real(field, line) if field else 0.0 for field in fields]).reshape(-1, 3)
    a, b = numbers[:2]
    if len(numbers) == 3 and not cylindrical:
        a, b = a - numbers[2], b - numbers[2]
    if cylindrical:
        a, b = scope.placed(a), scope.placed(b)
    else:
        a, b = scope.rotation @ a, scope.rotation @ b
    frame = Frame(name, cylindrical, a, b, card.source)
    # The first axis must exist at some point.
    frame.axes_at(a + np.array([1.3, 0.7, 0.4]))
    return frame, rows[1:]


@handles("ORIENTATION", used=("NAME", "SYSTEM"), idle=("DEFINITION",), lines=2)
def orientation(card, reader):
    system = card.key("SYSTEM", "RECTANGULAR")
    if system not in ("RECTANGULAR", "CYLINDRICAL"):
        raise Fault(f"SYSTEM={system} is not supported")
    if card.key("DEFINITION", "COORDINATES") != "COORDINATES":
        raise Fault("only DEFINITION=COORDINATES is supported", "DEFINITION")
    key, name = reader.defined(card, "NAME")
    if key in reader.model.orientations:
        raise Fault(f"the orientation '{name}' is defined twice")
    frame, more = _frame(card, name, system == "CYLINDRICAL", reader.scope)
    for line, fields in more:
        _turn(frame, fields, line)
    reader.model.orientations[key] = frame


def _turn(frame, fields, line):
    """Reads the axis about which the others are turned, and the angle in degrees."""
    axis = integer(fields[0], line) - 1 if fields[0] else 0
    angle = real(fields[1], line) if len(fields) > 1 and fields[1] else 0.0
    if axis not in range(3) or len(fields) > 2:
        raise Fault("the second line has an axis, 1 to 3, and an angle", line=line)
    if angle:
        frame.turn = axis, angle


@handles("TRANSFORM", used=("NSET", "TYPE"), lines=1)
def transform(card, reader):
    kind = card.key("TYPE", "R")
    if kind not in ("R", "C"):
        raise Fault(f"TYPE={kind} is not supported")
    label = reader.key(card, "NSET", reader.model.node_sets)
    number = 1 + len({frame.name for frame in reader.model.frames.values()})
    frame, _ = _frame(card, f"transform_{number}", kind == "C", reader.scope)
    for one in reader.model.node_sets.members(label):
        reader.model.frames[int(one)] = frame
