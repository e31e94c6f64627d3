# SPDX-License-Identifier: BSD-2-Clause
"""The faces of the interfaces as flat maps, seen from the disc."""
import numpy as np
from scipy.spatial import cKDTree

from squeal.blobs import blob

FLAT = 0.9  # a smaller mean of the unit normals belongs to a curved face, such as that of a pin
SMALL = 1e-300
SAME = 1e-8  # distance of equal places, relative to the size of the model


def linings(results, skin, surface, blobs):
    """Returns the flat interfaces, the sliding ones first, and adds their arrays to `blobs`.
    `surface` holds the places of the skin's nodes, which of them are contact nodes, and the
    rotation."""
    places, touching, rotation = surface
    tables = [results.steady(**at) for at in results.points.to_dict("records")]
    tables = [table for table in tables if table is not None and len(table)]
    if not tables or not touching.any():
        return []
    found = []
    order = np.cumsum(touching) - 1  # of a node among the contact nodes
    for name in dict.fromkeys(tables[0]["interface"]):
        rows = [table[table["interface"] == name] for table in tables]
        face = _face(skin, places, touching, rows[0][["x_m", "y_m", "z_m"]].to_numpy())
        if face is None:
            continue
        nodes, triangles = face
        axes = _axes(places[nodes], triangles, rotation)
        if axes is None:
            continue
        key = f"lining{len(found)}"
        blobs[key + "places"] = blob((places[nodes] @ axes[:2].T).astype(np.float32))
        blobs[key + "nodes"] = blob(order[nodes].astype(np.uint32))
        blobs[key + "triangles"] = blob(triangles.astype(np.uint32))
        found.append(
            {
                "name": name,
                "blob": key,
                "sliding": any((row["state"] == "sliding").any() for row in rows),
                "height": _height(places[nodes], rotation),
                "friction": _direction(rows, axes),
            }
        )
    return sorted(found, key=lambda lining: not lining["sliding"])


def _face(skin, places, touching, listed):
    """Returns the nodes of the skin at the listed places and the triangles between them; None if
    there are none. Both sides of an interface may have nodes there: only the body with most of
    them counts."""
    near, _ = cKDTree(listed).query(places)
    size = (places.max(axis=0) - places.min(axis=0)).max()
    at = touching & (near < SAME * size)
    if not at.any():
        return None
    body = max(skin.bodies, key=lambda one: at[slice(*one["nodes"])].sum())
    mine = np.zeros(len(at), bool)
    mine[slice(*body["nodes"])] = at[slice(*body["nodes"])]
    nodes = np.flatnonzero(mine)
    triangles = skin.triangles[slice(*body["triangles"])]
    triangles = triangles[mine[triangles].all(axis=1)]
    return (nodes, np.searchsorted(nodes, triangles)) if len(triangles) else None


def _axes(places, triangles, rotation):
    """Returns three axes as rows: to the right, up, and towards the eye, which is on the other side
    of the interface. Up is away from the axis of rotation, if it pierces the face. None for a
    curved face."""
    corners = places[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normals, axis=1).sum()
    normal = normals.sum(axis=0) / max(area, SMALL)
    if np.linalg.norm(normal) < FLAT:
        return None
    normal /= np.linalg.norm(normal)
    up = np.array([0.0, 0.0, 1.0])
    if rotation is not None and abs(normal @ rotation[0]) > FLAT:
        up = places.mean(axis=0) - rotation[1]
    for direction in (up, np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])):
        flat = direction - (direction @ normal) * normal
        if np.linalg.norm(flat) > 1e-3 * np.linalg.norm(direction):
            flat /= np.linalg.norm(flat)
            return np.array([np.cross(flat, normal), flat, normal])
    return None


def _height(places, rotation):
    """The mean place along the axis of rotation."""
    return 0.0 if rotation is None else float(((places - rotation[1]) @ rotation[0]).mean())


def _direction(rows, axes):
    """Returns the mean direction of the friction force on this side, in the plane of the map; None
    without friction."""
    names = ["friction_force_x_n", "friction_force_y_n", "friction_force_z_n"]
    flat = axes[:2] @ sum(row[names].to_numpy().sum(axis=0) for row in rows)
    size, normal = np.linalg.norm(flat), sum(row["normal_force_n"].sum() for row in rows)
    return (flat / size).tolist() if size > 1e-9 * max(abs(normal), SMALL) else None


__all__ = ["linings"]
