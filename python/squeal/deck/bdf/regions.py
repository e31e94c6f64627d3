# SPDX-License-Identifier: BSD-2-Clause
"""Regions of contact: faces of elements (BSURFS, BCSURF), or bodies by elements and properties
(BSURF, BCPROP, BCPROPS, through BCBODY1 as well), of which the faces that face each other count."""
import numpy as np

from squeal.deck.bdf.handlers import handles
from squeal.deck.journal import TRANSLATED, USED, Fault
from squeal.deck.mesh import EMPTY, Surface

FACING = -0.7  # cosine between the normals of two faces that face each other, at most
NEIGHBOURS = 12  # faces of the other body that are looked at


@handles("BSURFS")
def bsurfs(card, reader):
    """Elements with three corner grids of a face each; fields 3 to 5 are blank."""
    _faces(card, reader, 5)


@handles("BCSURF")
def bcsurf(card, reader):
    for at in (2, 6, 7, 8):
        card.pass_over(at)
    if card.word(3, "3D") != "3D" or card.word(4, "FACE") != "GRID":
        raise Fault("only the form GRID in three dimensions is supported", "FORM", card.line)
    _faces(card, reader, 9)


def _faces(card, reader, first):
    number = card.identifier(1)
    name = f"{card.name.lower()}_{number}"
    elements, faces = [], []
    for at in range(first, len(card.fields), 4):
        if card.word(at):
            elements.append(card.identifier(at))
            corners = {card.identifier(at + one) for one in (1, 2, 3)}
            faces.append(_face(card, reader, elements[-1], corners))
    if not elements:
        raise Fault("no face is named", line=card.line)
    surface = Surface(name, card.source, None, np.array(elements), np.array(faces))
    _add(card, reader, number, surface)


def _add(card, reader, number, region):
    if number in reader.regions:
        raise Fault(f"region {number} is defined twice", line=card.line)
    reader.regions[number] = region


def _face(card, reader, element, corners):
    """Returns the number of the face of an element that has three corners."""
    shape, nodes = reader.solid(element, card.line)
    for number, face in enumerate(shape.corners):
        if len(corners) == 3 and corners <= {nodes[at] for at in face}:
            return number
    grids = ", ".join(map(str, sorted(corners)))
    raise Fault(f"the grids {grids} are on no face of element {element}", line=card.line)


@handles("BSURF")
def bsurf(card, reader):
    """Elements, with THRU and BY."""
    number, found, at = card.identifier(1), [], 2
    while at <= len(card.fields):
        if not card.word(at):
            at += 1
            continue
        first = last = card.identifier(at)
        step, at = 1, at + 1
        if card.word(at) == "THRU":
            last, at = card.identifier(at + 1), at + 2
            if card.word(at) == "BY":
                step, at = card.identifier(at + 1), at + 2
        if last < first:
            raise Fault(f"the range {first} THRU {last} is empty", line=card.line)
        known = reader.cells
        low, high = np.searchsorted(known, [first, last + 1])
        inside = known[low:high]
        found.append(inside[(inside - first) % step == 0])
    _add(card, reader, number, _body(card, reader, number, np.concatenate([EMPTY, *found])))


@handles("BCPROP", "BCPROPS")
def bcprop(card, reader):
    number = card.identifier(1)
    found = [EMPTY]
    for first, last in card.numbers(2):
        for table in reader.solids.tables.values():
            found.append(table[(table[:, 1] >= first) & (table[:, 1] <= last), 0])
    _add(card, reader, number, _body(card, reader, number, np.concatenate(found)))


def _body(card, reader, number, elements):
    if not len(elements):
        raise Fault("it has no solid elements", line=card.line)
    name = f"{card.name.lower()}_{number}"
    reader.model.element_sets.add(name.upper(), name, card.source, [elements])
    return name, np.unique(elements), card.source


@handles("BCBODY1", phase=3)
def bcbody1(card, reader):
    """A contact body, by the number of its region."""
    number, region = card.identifier(1), card.identifier(5)
    if card.word(3, "3D") != "3D" or card.word(4, "DEFORM") != "DEFORM":
        raise Fault("only bodies of solid elements are supported", "BEHAV", card.line)
    for at in (2, 7):
        card.pass_over(at)
    if number in reader.contact_bodies:
        raise Fault(f"contact body {number} is defined twice", line=card.line)
    if region not in reader.regions:
        raise Fault(f"there is no BSURF or BCPROP {region}", line=card.line)
    reader.contact_bodies[number] = reader.regions[region]


class Outside:
    """Outer faces of the cells of a model, with their centres, normals and sizes."""

    def __init__(self, model):
        rows, keys = [], []
        for block in model.blocks:
            for number, face in enumerate(block.shape.corners if block.shape else ()):
                corners = block.nodes[:, face]
                padded = np.full((len(corners), 4), -1)
                padded[:, : len(face)] = np.sort(corners, axis=1)
                keys.append(padded)
                table = np.full((len(corners), 6), -1)
                table[:, 0], table[:, 1] = block.numbers, number
                table[:, 2 : 2 + len(face)] = corners
                rows.append(table)
        rows, keys = np.concatenate(rows), np.concatenate(keys)
        _, first, counts = np.unique(keys, axis=0, return_index=True, return_counts=True)
        self.rows = rows[np.sort(first[counts == 1])]
        nodes = self.rows[:, 2:6]
        last = np.where(nodes[:, 3] < 0, nodes[:, 2], nodes[:, 3])
        corners = [model.nodes.at(column) for column in (*nodes[:, :3].T, last)]
        across = np.cross(corners[2] - corners[0], corners[3] - corners[1])
        flat = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        normal = np.where((nodes[:, 3] < 0)[:, None], flat, across)
        areas = np.linalg.norm(normal, axis=1) / 2
        self.sizes = np.sqrt(areas)
        self.normals = normal / np.maximum(2 * areas[:, None], np.finfo(float).tiny)
        triangle = (nodes[:, 3] < 0)[:, None]
        three = sum(corners[:3])
        self.centres = np.where(triangle, three / 3, (three + corners[3]) / 4)

    def of(self, elements):
        """Returns the places of the outer faces of elements."""
        return np.flatnonzero(np.isin(self.rows[:, 0], elements))

    def size_of(self, elements):
        """Returns the mean size of the outer faces of elements."""
        return float(np.mean(self.sizes[self.of(elements)]))

    def facing(self, one, other):
        """Returns the places among `one` of faces that have a face of `other` opposite to them,
        half their size before it or a tenth behind it, and their size beside it."""
        from scipy.spatial import cKDTree  # only here: other decks do without this package

        if not len(one) or not len(other):
            return one[:0]
        tree = cKDTree(self.centres[other])
        count = min(NEIGHBOURS, len(other))
        _, near = tree.query(self.centres[one], k=count)
        near = other[np.asarray(near).reshape(len(one), count)]
        away = self.centres[near] - self.centres[one][:, None]
        normals = self.normals[one][:, None]
        gap = np.einsum("ijk,ijk->ij", away, np.broadcast_to(normals, away.shape))
        beside = np.linalg.norm(away - gap[:, :, None] * normals, axis=2)
        size = np.maximum(self.sizes[near], self.sizes[one][:, None])
        cosine = np.einsum("ijk,ijk->ij", self.normals[near], np.broadcast_to(normals, away.shape))
        near_enough = (gap <= size / 2) & (gap >= -size / 10) & (beside <= size)
        fits = near_enough & (cosine <= FACING)
        return one[np.any(fits, axis=1)]


def region_of(reader, number, card):
    """Returns a surface, or a body (name, elements, source). Raises Fault."""
    found = reader.contact_bodies.get(number, reader.regions.get(number))
    if found is None:
        raise Fault(f"there is no contact region {number}", line=card.line)
    reader.journal.mark(found.source if isinstance(found, Surface) else found[2], TRANSLATED)
    return found


def surfaces_of(reader, first, second, card):
    """Returns the keys of the surfaces of two regions in contact; of bodies these are the faces
    that face the other one. Raises Fault."""
    pair = [region_of(reader, number, card) for number in (first, second)]
    keys = []
    if not any(isinstance(one, Surface) for one in pair):
        outside = reader.outside()
        rows = [outside.of(one[1]) for one in pair]
        chosen = [outside.facing(rows[0], rows[1]), outside.facing(rows[1], rows[0])]
        for one, other, faces in zip(pair, pair[::-1], chosen):
            if not len(faces):
                raise Fault(f"{one[0]} has no face opposite to {other[0]}", line=card.line)
            name = f"{one[0]}_to_{other[0]}"
            table = outside.rows[faces]
            surface = Surface(name, card.source, None, table[:, 0], table[:, 1])
            reader.model.surfaces[name] = surface
            keys.append(name)
            reader.journal.choose(
                f"{card.source}: {len(faces)} faces of {one[0]} face {other[0]} within half their"
                " size"
            )
        return keys
    for one in pair:
        if not isinstance(one, Surface):
            raise Fault("a body and a region of faces in one contact are not supported")
        reader.model.surfaces[one.name] = one
        keys.append(one.name)
    return keys


def name_idle(reader):
    """Marks regions that no contact has."""
    for region in (*reader.regions.values(), *reader.contact_bodies.values()):
        source = region.source if isinstance(region, Surface) else region[2]
        if not reader.journal.entries[source].status:
            reader.journal.mark(source, USED, "no contact has this region")
