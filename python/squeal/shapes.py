# SPDX-License-Identifier: BSD-2-Clause
"""The surface of the bodies in the report, its contact fields, and the shapes of the modes."""
import numpy as np

from squeal import blobs as packing
from squeal.blobs import blob
from squeal.exploded import offsets, rotation_of
from squeal.files import ResultsError
from squeal.keys import PARAMETERS
from squeal.linings import linings
from squeal.skin import Skin

SMALL = 1e-300


def add_shapes(results, kept, data, blobs):
    """Adds the surface, the contact fields and the shapes of the kept modes to the data of a
    report."""
    mesh = results.mesh
    skin = Skin(mesh)
    places = np.pad(mesh.coordinates, ((0, 0), (0, 3 - mesh.coordinates.shape[1])))[skin.nodes]
    low, high = places.min(axis=0), places.max(axis=0)
    size = max((high - low).max(), SMALL)
    blobs["places"] = blob(np.round((places - (low + high) / 2) / size * 65534).astype(np.int16))
    blobs["triangles"] = blob(skin.triangles.astype(np.uint32))
    blobs["lines"] = blob(skin.lines.astype(np.uint32))
    touching = _add_contact(results, skin, data, blobs)
    rotation = rotation_of(results.summary.get("options", {}), skin.bodies)
    data["linings"] = linings(results, skin, (places, touching, rotation), blobs)
    apart = offsets(places, skin.bodies, rotation, data["linings"])
    for body, offset in zip(skin.bodies, apart):
        body["apart"] = (offset / size).tolist()
        body["volume"] = _volume(places[skin.triangles[slice(*body["triangles"])]])
    data["skin"].update(size=size, bodies=skin.bodies)
    _add_modes(results, kept, (skin, touching), data, blobs)
    _add_limits(skin, mesh, data)


def _volume(corners):
    """The volume within triangles [triangle, corner, component]; of a plane body its area."""
    a, b, c = (corners - corners.mean(axis=(0, 1))).transpose(1, 0, 2)
    volume = abs(np.einsum("ij,ij->", a, np.cross(b, c))) / 6
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    return float(volume if volume > 1e-9 * area**1.5 else area)


def _add_contact(results, skin, data, blobs):
    """Adds the contact fields; returns which nodes of the skin are contact nodes."""
    touching, fields, points = _contact(results, skin)
    blobs["touching"] = blob(np.flatnonzero(touching).astype(np.uint32))
    blobs["steady"] = blob(fields.astype(np.float32))
    every = len(points)
    while len(blobs["steady"]) > packing.MOST_BYTES // 4 and len(points) > 1:
        fields, points = fields[::2], points[::2]
        blobs["steady"] = blob(fields.astype(np.float32))
    if len(points) < every:
        data["left"].append(
            f"Contact fields are shown at {len(points)} of the {every} points of the sweep: the"
            " file would be too large."
        )
    data["skin"] = {
        "nodes": len(skin.nodes),
        "touching": int(touching.sum()),
        "steady": points,
    }
    return touching


def _contact(results, skin):
    """Returns which nodes of the skin are contact nodes, pressure and gap as [point, 2, contact
    node], and the parameters of the points."""
    touching, fields, points = np.zeros(len(skin.nodes), bool), [], []
    for at in results.points.to_dict("records"):
        try:
            field = results.fields(**at).get("contact_pressure_gap")
        except ResultsError:  # a point without steady sliding
            continue
        if field is not None and field.shape[1] >= 2:
            touching |= np.any(field[skin.nodes] != 0, axis=1)
            fields.append(field[skin.nodes, :2])  # not the whole field: there may be many points
            points.append([at[name] for name in PARAMETERS])
    if not fields:
        return touching, np.zeros((0, 2, 0)), []
    return touching, np.stack([field[touching].T for field in fields]), points


def _add_modes(results, kept, surface, data, blobs):
    """Adds the shapes, the fastest growing first, as far as they fit."""
    skin, touching = surface
    total = sum(len(text) for text in blobs.values())
    order = kept.sort_values("growth_rate_1_per_s", ascending=False)
    for row in order.itertuples():
        mode = results.mode(int(row.mode), **{name: getattr(row, name) for name in PARAMETERS})
        text = _shape(mode, skin)
        work = ""
        if mode.friction_work is not None and touching.any():
            work = blob(mode.friction_work[skin.nodes[touching], 1].astype(np.float32))
        total += len(text) + len(work)
        if total > packing.MOST_BYTES:
            data["left"].append(
                f"The shapes of {len(order) - len(data['shapes'])} slower growing modes were left"
                " out: the file would be too large."
            )
            break
        name = f"shape{len(data['shapes'])}"
        blobs[name] = text
        entry = {
            "blob": name,
            "mode": int(row.mode),
            "at": [float(getattr(row, key)) for key in PARAMETERS],
            "work": None,
        }
        if work:
            blobs[name + "work"] = work
            entry["work"] = name + "work"
        data["shapes"].append(entry)


def _shape(mode, skin):
    """A mode on the nodes of the skin: real and imaginary part, in 127ths of its largest
    component."""
    shape = np.pad(mode.shape, ((0, 0), (0, 3 - mode.shape.shape[1])))
    largest = max(np.abs(np.concatenate([shape.real, shape.imag])).max(), SMALL)
    parts = np.concatenate([shape.real[skin.nodes], shape.imag[skin.nodes]], axis=1) / largest
    return blob(np.round(127 * parts).astype(np.int8))


def _add_limits(skin, mesh, data):
    """Adds sentences on everything that is not drawn."""
    if skin.detail:
        data["left"].append(
            f"The surface has {skin.whole} triangles and is drawn with {len(skin.triangles)}, on"
            f" {len(skin.nodes)} of its nodes: details below {skin.detail:.2g} m are not seen."
        )
    if skin.unseen:
        data["left"].append(f"Bodies that are smaller are not drawn: {', '.join(skin.unseen)}.")
    if any(kind in (9, 10, 11, 12, 13, 14, 16, 17, 18, 19) for kind in mesh.cells):
        data["left"].append("Nodes amid the edges of cells are not drawn.")
    data["left"].append(
        "Shapes are drawn to 1/127 of their largest displacement, places to 1/65534 of the size of"
        " the brake."
    )


__all__ = ["add_shapes"]
