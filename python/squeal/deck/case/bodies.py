# SPDX-License-Identifier: BSD-2-Clause
"""Bodies of a case: cells with one material, one orientation, one quadrature and equal loads."""
import numpy as np

from squeal.deck.case.groups import CELLS
from squeal.deck.case.pieces import Piece, bodies_of, instances_of
from squeal.deck.journal import TRANSLATED, UNUSED, Fault
from squeal.deck.mesh import EMPTY

REDUCED = {"C3D20R", "CHEXA20_TWO"}
# Hexahedra without and with incompatible modes.
PLAIN, INCOMPATIBLE = ("C3D8", "CHEXA8_FULL"), ("C3D8I", "CHEXA8")
# Cells that CalculiX integrates with fewer points, and the largest differences of results, measured
# with a bar of 2 x 2 x 6 cells.
COARSER = {
    "C3D4": "its frequencies differ by up to 5 %",
    "C3D6": "its displacements differ by 0.3 % and its frequencies by up to 11 %",
    "C3D10": "its frequencies differ by up to 0.06 %",
    "C3D15": "its displacements differ by 0.01 % and its frequencies by 0.07 %",
}
BY_VOLUME = ("FORCE", "CENT")  # loads whose acceleration depends on the density
OPTION = {
    **{"engineering": "engineering_constants", "orthotropic": "orthotropic"},
    "anisotropic": "anisotropic",
}


def add_bodies(model, case, journal):
    """Divides the solid cells into bodies, and sets their materials and body loads."""
    solids = [block for block in model.blocks if block.shape]
    numbers = np.concatenate([EMPTY, *(block.numbers for block in solids)])
    if not len(numbers):
        if not journal.incomplete:
            journal.refuse_model("the deck has no solid elements")
        return
    pieces = _pieces(model, solids, numbers, journal)
    instances = [piece.instance for piece in pieces]
    for body in bodies_of(pieces, model):
        instance = body[0].instance
        whole = instance >= 0 and instances.count(instance) == len(body)
        wanted = model.instances[instance].name if whole else ""
        name = _body(body, wanted, model, case, journal)
        case.bodies[name] = np.concatenate([piece.cells for piece in body])
        chosen = [model.state.body_loads[number] for number in body[0].loads]
        _body_loads(case, journal, name, chosen, body[0].density)
    _element_options(model, case, journal, solids)


def _pieces(model, solids, numbers, journal):
    """Divides the cells by section, quadrature, instance and loads."""
    reduced = np.concatenate(
        [np.full(len(block.numbers), block.kind in REDUCED) for block in solids]
    )
    sections = _sections(model, numbers, journal)
    loads = model.state.body_loads
    acting = [np.isin(numbers, load.elements) for load in loads]
    columns = [sections, reduced, instances_of(model, numbers), *acting]
    kinds, inverse = _kinds(columns)
    pieces = []
    for number, (section, fully, instance, *acts) in enumerate(kinds.tolist()):
        if section < 0:
            continue
        chosen = tuple(np.flatnonzero(acts).tolist())
        piece = Piece(section, bool(fully), instance, chosen, numbers[inverse == number])
        material = model.materials.get(model.sections[section].material)
        if any(loads[one].kind in BY_VOLUME for one in chosen):
            # A material without density is refused.
            piece.density = material.density if material and material.density else 1.0
        pieces.append(piece)
    return pieces


def _kinds(columns):
    """Returns the different rows of columns in ascending order, and the number of each row among
    them. Most columns have one value, so that sorting whole rows is slow."""
    number = np.zeros(len(columns[0]), np.int64)
    for column in columns:
        if np.any(column != column[0]):
            values, place = np.unique(column, return_inverse=True)
            _, number = np.unique(number * len(values) + place, return_inverse=True)
    _, first = np.unique(number, return_index=True)
    return np.column_stack([column[first] for column in columns]), number


def _body(pieces, wanted, model, case, journal):
    """Sets the materials of the pieces of a body, and returns its name."""
    if len(pieces) == 1:
        return _section(pieces[0], wanted, model, case, journal)
    names = [_section(piece, "", model, case, journal) for piece in pieces]
    cells = np.sort(np.concatenate([piece.cells for piece in pieces]))
    name = wanted or _set_of(cells, model) or f"{names[0]}_and_more"
    name = case.reserve(name, CELLS)
    source = model.sections[pieces[0].section].source
    case.set(("material", name, "sections"), ",".join(names), source)
    return name


def _set_of(cells, model):
    """Returns the name of an element set with exactly these cells, or an empty text."""
    sets = model.element_sets
    for key in sets:
        try:
            if np.array_equal(np.sort(sets.members(key)), cells):
                return sets.spelled[key]
        except Fault:
            continue  # refused where it is used
    return ""


def _section(piece, wanted, model, case, journal):
    """Sets the material of a piece, and returns the name of its group."""
    one = model.sections[piece.section]
    name = case.group(CELLS, piece.cells, wanted or model.element_sets.spelled[one.label])
    loads = [model.state.body_loads[number] for number in piece.loads]
    _material(model, case, journal, name, one, loads)
    if piece.reduced:
        case.set(("material", name, "integration"), "reduced", one.source)
    return name


def _sections(model, numbers, journal):
    """Returns for each cell the number of its section, −1 without one."""
    sections = np.full(len(numbers), -1)
    for number, section in enumerate(model.sections):
        on = np.isin(numbers, section.elements)
        if not np.any(on):
            journal.mark(section.source, UNUSED, "its set has no solid elements")
        elif np.any(sections[on] >= 0):
            twice = numbers[on & (sections >= 0)][0]
            journal.refuse(section.source, f"element {model.element_label(twice)} has two sections")
        sections[on] = number
    if np.any(sections < 0):
        missing, card = numbers[sections < 0], model.word("SOLID SECTION")
        journal.refuse_model(f"{len(missing)} solid elements have no {card}, such as {missing[0]}")
    return sections


def _material(model, case, journal, body, section, loads):
    material = model.materials.get(section.material)
    if material is None:
        journal.refuse(section.source, f"there is no material '{section.material}'")
        return
    for refusal in material.refusals:
        journal.refuse(*refusal)
    if not material.law:
        if not material.refusals and material.elastic is None:
            lacking = f"material '{material.name}' has no {model.word('ELASTIC')}"
            journal.refuse(material.source, lacking)
        return
    path = ("material", body)
    if material.law == "isotropic":
        case.set((*path, "young"), material.constants[0], material.elastic)
        case.set((*path, "poisson"), material.constants[1], material.elastic)
    else:
        case.set((*path, OPTION[material.law]), material.constants, material.elastic)
    if material.loss is not None:
        case.set((*path, "loss_factor"), material.loss[0], material.source)
        case.set((*path, "loss_frequency"), material.loss[1], material.source)
    _orientation(model, case, journal, path, section, material)
    _density(model, case, journal, path, material, loads)
    for source in (material.source, material.elastic, section.source):
        journal.mark(source, TRANSLATED)


def _orientation(model, case, journal, path, section, material):
    if section.orientation is None:
        return
    frame = model.orientations.get(section.orientation)
    if frame is None:
        journal.refuse(section.source, f"there is no orientation '{section.orientation}'")
    elif material.law == "isotropic":
        journal.mark(frame.source, UNUSED, "without effect on an isotropic material")
    elif frame.turn:
        journal.mark(frame.source, TRANSLATED)
        case.set((*path, "frame"), case.frame(frame), frame.source)
    elif frame.cylindrical:
        journal.mark(frame.source, TRANSLATED)
        case.set((*path, "cylindrical"), [*frame.a, *(frame.b - frame.a)], frame.source)
    else:
        journal.mark(frame.source, TRANSLATED)
        case.set((*path, "orientation"), [*frame.a, *frame.b], frame.source)


def _density(model, case, journal, path, material, loads):
    if material.damping_source is not None:
        journal.mark(material.damping_source, TRANSLATED)
        for key, value in zip(("rayleigh_mass", "rayleigh_stiffness"), material.damping):
            if value:
                case.set((*path, key), value, material.damping_source)
    if material.density is not None:
        journal.mark(material.density_source, TRANSLATED)
        case.set((*path, "density"), material.density, material.density_source)
        return
    needs = [load.source for load in loads]
    if model.frequency:
        needs.append(model.frequency)
    lacking = f"material '{material.name}' has no {model.word('DENSITY')}"
    for source in needs:
        journal.refuse(source, lacking)
    journal.choose(
        f"{lacking}: the density 1 is used, so the frequencies of the case have no meaning"
    )
    case.set((*path, "density"), 1.0)


def _body_loads(case, journal, body, loads, density):
    gravity = [load for load in loads if load.kind in ("GRAV", "FORCE")]
    spins = [load for load in loads if load.kind in ("CENTRIF", "CENT")]
    if gravity:
        total = sum(
            load.amount / (density if load.kind == "FORCE" else 1.0) * load.direction
            for load in gravity
        )
        case.set(("load", body, "acceleration"), total, gravity[-1].source)
    if len(spins) > 1:
        journal.refuse(spins[-1].source, f"body '{body}' has two loads of rotation", "CENTRIF")
    elif spins:
        (spin,) = spins
        speed = np.sqrt(spin.amount / density) if spin.kind == "CENT" else spin.amount
        case.set(("load", body, "spin"), speed, spin.source)
        case.set(("load", body, "spin_axis"), spin.direction, spin.source)
        case.set(("load", body, "spin_origin"), spin.origin, spin.source)


def _element_options(model, case, journal, solids):
    kinds = {block.kind: block.source for block in solids}
    if model.program == "Abaqus" and "C3D8" in kinds and "C3D8I" not in kinds:
        journal.choose(
            "C3D8: full integration; Abaqus integrates the change of volume with one point, which"
            " matters near Poisson's ratio 0.5"
        )
    for plain, bent in zip(PLAIN, INCOMPATIBLE):
        if plain in kinds and bent in kinds and model.program == "Abaqus":
            journal.choose("C3D8, C3D8I and C3D8R in one deck: all have incompatible modes")
        elif plain in kinds and bent in kinds:
            reason = f"{plain} and {bent} in one deck: incompatible modes are for all or none"
            journal.refuse(kinds[bent], reason)
        elif plain in kinds:
            case.set(("elasticity", "incompatible_modes"), "none", kinds[plain])
        elif bent in kinds:
            journal.choose(f"{bent}: the incompatible modes are those of this program")
    if model.program == "Abaqus":
        return
    for kind, difference in COARSER.items():
        if kind in kinds and (model.frequency or "displacements" in difference):
            journal.choose(f"{kind}: CalculiX integrates with fewer points; {difference}")
    if REDUCED & set(kinds) and model.frequency:
        journal.choose(
            "C3D20R: the mass has full integration; CalculiX reduces it like the stiffness, which"
            " changes frequencies of coarse meshes"
        )
