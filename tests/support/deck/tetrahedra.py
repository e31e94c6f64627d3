# SPDX-License-Identifier: BSD-2-Clause
"""A geometry of gmsh as tetrahedra with named bodies and faces, by gmsh's library."""
import ctypes
import ctypes.util

import numpy as np


def mesh_of(geometry, path, parameters):
    """Meshes a .geo file with values of its parameters, writes the mesh in the format 2.2, and
    returns it."""
    gmsh, code = ctypes.CDLL(ctypes.util.find_library("gmsh")), ctypes.c_int(0)
    steps = [("Initialize", 0, None, 1), ("OptionSetNumber", b"General.Terminal", 0.0)]
    steps += [("OptionSetNumber", b"Mesh.MshFileVersion", 2.2)]
    for name, value in parameters.items():
        values = (ctypes.c_double * 1)(value)
        steps.append(("OnelabSetNumber", name.encode(), values, ctypes.c_size_t(1)))
    steps += [("Open", str(geometry).encode()), ("ModelMeshGenerate", 3)]
    steps += [("Write", str(path).encode()), ("Finalize",)]
    for name, *words in steps:
        words = [ctypes.c_double(word) if isinstance(word, float) else word for word in words]
        getattr(gmsh, f"gmsh{name}")(*words, ctypes.byref(code))
        if code.value:
            raise RuntimeError(f"gmsh{name} has failed: {code.value}")
    return Tetrahedra(path.read_text())


def _section(text, name):
    start = text.index(f"${name}\n") + len(name) + 2
    return text[start : text.index(f"\n$End{name}", start)].split("\n")[1:]


class Tetrahedra:
    """`places` by node number; `bodies` and `faces`: rows of nodes by the name of their group."""

    def __init__(self, text):
        table = np.array([row.split() for row in _section(text, "Nodes")], float)
        self.places = dict(zip(table[:, 0].astype(int).tolist(), table[:, 1:]))
        names = {}
        for row in _section(text, "PhysicalNames"):
            dimension, number, name = row.split(" ", 2)
            names[dimension, number] = name.strip('"')
        self.bodies, self.faces = {}, {}
        kinds = {"4": ("3", self.bodies), "11": ("3", self.bodies)}
        kinds |= {"2": ("2", self.faces), "9": ("2", self.faces)}
        for row in _section(text, "Elements"):
            _, kind, tags, group, *rest = row.split()
            if kind in kinds:
                dimension, found = kinds[kind]
                nodes = [int(word) for word in rest[int(tags) - 1 :]]
                found.setdefault(names[dimension, group], []).append(nodes)
