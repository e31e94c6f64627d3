# SPDX-License-Identifier: BSD-2-Clause
"""Properties and materials of solid elements: PSOLID, MAT1 and MAT9."""
import numpy as np

from squeal.deck.bdf.handlers import handles
from squeal.deck.journal import Fault
from squeal.deck.model import Material, Section

# Our order of strains is 11, 22, 33, 12, 13, 23, that of MAT9 is 11, 22, 33, 12, 23, 31.
STRAINS = (0, 1, 2, 3, 5, 4)
ORTHOTROPIC = ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2), (3, 3), (4, 4), (5, 5))
ANISOTROPIC = tuple((row, column) for column in range(6) for row in range(column + 1))


@handles("PSOLID", phase=0)
def psolid(card, reader):
    number = card.identifier(1)
    if number in reader.properties:
        raise Fault(f"property {number} is defined twice")
    scheme, network = card.word(6, "REDUCED"), card.word(4)
    if scheme not in ("REDUCED", "FULL", "0", "1"):
        reader.journal.refuse(card.source, f"{scheme} is not supported", "ISOP")
    if network not in ("", "0", "BUBBLE", "2", "TWO", "3", "THREE"):
        reader.journal.refuse(card.source, f"{network} is not supported", "IN")
    if card.word(7, "SMECH") != "SMECH":
        reason = f"{card.word(7)}: elements of fluids are not supported"
        reader.journal.refuse(card.source, reason, "FCTN")
    card.pass_over(5)  # stress output
    material, system = card.identifier(2), card.integer(3, 0)
    few = network in ("2", "TWO")
    reader.properties[number] = few, scheme in ("FULL", "1"), card.source
    orientation = None
    if system != 0:
        orientation = f"CORD_{system}"
        reader.orientations.append((system, orientation, card.source))
    label = f"PSOLID_{number}"
    elements = np.concatenate(
        [np.zeros(0, np.int64)]
        + [table[table[:, 1] == number, 0] for table in reader.solids.tables.values()]
    )
    reader.model.element_sets.add(label, label.lower(), card.source, [elements])
    reader.model.sections.append(Section(elements, label, str(material), orientation, card.source))


def _new(card, reader):
    number = str(card.identifier(1))
    if number in reader.model.materials:
        raise Fault(f"material {number} is defined twice")
    one = reader.model.materials[number] = Material(number, card.source, elastic=card.source)
    return one


def _density(one, density, card, reader):
    if density < 0:
        raise Fault("the density is negative", line=card.line)
    if density > 0:
        one.density, one.density_source = density * reader.mass_factor, card.source


def _damping(card, number, one, reader):
    """Structural damping is a loss factor, exact at the frequency of PARAM,W4; real modes have
    none."""
    factor = card.real(number, 0.0)
    if factor == 0:
        return
    if not reader.selection.complex:
        reader.journal.remark(card.source, "GE is not used: modes without damping are computed")
    elif reader.parameters.get("W4"):
        one.loss = factor, reader.parameters["W4"] / (2 * np.pi)
    else:
        reason = "it needs the frequency at which it is exact: give PARAM,W4 in rad/s"
        one.refusals.append((card.source, reason, "GE"))


@handles("MAT1", phase=0)
def mat1(card, reader):
    one = _new(card, reader)
    young, shear, poisson = (card.real(at, None) for at in (2, 3, 4))
    if young is None and shear is None:
        raise Fault("E and G are blank", line=card.line)
    if young is None:
        poisson = poisson or 0.0
        young = 2 * (1 + poisson) * shear
    elif poisson is None:
        poisson = young / (2 * shear) - 1 if shear else 0.0
    elif shear is not None and abs(young / (2 * (1 + poisson)) - shear) > 1e-3 * abs(shear):
        reason = f"it differs from E / (2 + 2 NU) = {young / (2 * (1 + poisson)):.6g}"
        one.refusals.append((card.source, reason, "G"))
    one.law, one.constants = "isotropic", (young, poisson)
    _density(one, card.real(5, 0.0), card, reader)
    _thermal(card, (6, 7), reader)
    _damping(card, 8, one, reader)
    for number in (9, 10, 11, 12):
        card.pass_over(number)  # limits of stresses, and axes of output


def _thermal(card, numbers, reader):
    """Expansion has no effect, since temperatures are refused."""
    if any([card.real(number, 0.0) for number in numbers]):
        reader.journal.remark(card.source, "expansion is not used: temperatures are refused")


@handles("MAT9", phase=0)
def mat9(card, reader):
    one = _new(card, reader)
    matrix = np.zeros((6, 6))
    rows, columns = np.triu_indices(6)
    values = card.reals(2, 21, 0.0)
    matrix[rows, columns] = matrix[columns, rows] = values
    matrix = matrix[np.ix_(STRAINS, STRAINS)]
    try:
        np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        raise Fault("the matrix of stiffness is not positive definite", line=card.line) from None
    pairs = ORTHOTROPIC
    one.law = "orthotropic"
    remainder = matrix.copy()
    for row, column in ORTHOTROPIC:
        remainder[row, column] = remainder[column, row] = 0
    if np.any(remainder):
        one.law, pairs = "anisotropic", ANISOTROPIC
    one.constants = tuple(float(matrix[pair]) for pair in pairs)
    _density(one, card.real(23, 0.0), card, reader)
    _thermal(card, range(24, 31), reader)
    _damping(card, 31, one, reader)
    if any([card.real(number, 0.0) for number in range(33, 54)]):
        reader.journal.refuse(card.source, "a matrix of damping is not supported", "GEIJ")


def quadrature(reader):
    """Returns a function of property and shape: the ending of the kind of its elements."""

    def ending(number, shape):
        few, full, source = reader.properties.get(number, (False, False, None))
        if shape.name == "hex20":
            if few and not full:
                reader.journal.choose(f"{source}: the strains of shear have 2x2x2 points as well")
            return "_TWO" if few else ""
        if shape.name == "hex8":
            return "_FULL" if full else ""
        if few and full and shape.name != "tet4":
            reader.journal.choose(f"{source}: {shape.name} cells have the full quadrature")
        return ""

    return ending


def orient(reader):
    """Adds the axes of materials, when all systems are known."""
    for number, key, source in reader.orientations:
        try:
            if number < 0:
                raise Fault("axes of the elements (CORDM < 0) are not supported", "CORDM")
            system = reader.systems.at(number)
            if system.kind == "spherical":
                raise Fault("spherical axes of a material are not supported", "CORDM")
        except Fault as fault:
            reader.journal.refuse(source, fault.reason, fault.name)
            for section in reader.model.sections:
                if section.source is source:
                    section.orientation = None
        else:
            reader.model.orientations[key] = system.frame()
