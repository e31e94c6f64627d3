#!/usr/bin/python3
"""Picture of the fastest growing complex mode of a run: plot_mode.py REPORT_DIR [FRICTION] [-o FILE.png]

Reads results.h5; draws the boundary of the mesh, deformed by the real part of the mode, coloured by its amplitude.
"""
import argparse
import collections
import os
import sys

import h5py
import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

from results import Results  # noqa: E402

# Corner nodes of the faces of the cell types, in gmsh's order; a plane cell is its own face.
TETRAHEDRON = [[0, 1, 2], [0, 1, 3], [1, 2, 3], [0, 2, 3]]
HEXAHEDRON = [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
PYRAMID = [[0, 1, 2, 3], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
WEDGE = [[0, 1, 2], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]]
FACES = {2: [[0, 1, 2]], 9: [[0, 1, 2]], 3: [[0, 1, 2, 3]], 10: [[0, 1, 2, 3]], 16: [[0, 1, 2, 3]],
         4: TETRAHEDRON, 11: TETRAHEDRON, 5: HEXAHEDRON, 12: HEXAHEDRON, 17: HEXAHEDRON, 6: WEDGE, 13: WEDGE, 18: WEDGE,
         7: PYRAMID, 14: PYRAMID, 19: PYRAMID}


def boundary(mesh):
    """Faces that belong to one cell only."""
    count = collections.Counter()
    faces = {}
    for name in mesh:
        if not name.startswith("cells_"):
            continue
        cell_type = int(name.split("_")[1])
        nodes = numpy.asarray(mesh[name]["nodes"], dtype=int)
        for corners in FACES[cell_type]:
            for face in nodes[:, corners]:
                key = tuple(sorted(face))
                count[key] += 1
                faces[key] = face
    return [face for key, face in faces.items() if count[key] == 1]


def fastest(flutter, friction):
    """Group, dataset stem and eigenvalue of the fastest growing mode that was kept."""
    best = None
    for group in flutter:
        if friction is not None and abs(float(group.split("_")[1]) - friction) > 1e-12:
            continue
        eigenvalues = numpy.asarray(flutter[group]["eigenvalues"])
        for name in flutter[group]:
            if not name.endswith("_real"):
                continue
            row = eigenvalues[int(name.split("_")[1]) - 1]
            if best is None or row[0] > best[2][0]:
                best = (group, name[: -len("_real")], row)
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("report_dir")
    parser.add_argument("friction", nargs="?", type=float)
    parser.add_argument("-o", "--output")
    arguments = parser.parse_args()
    added = Results(arguments.report_dir)
    with h5py.File(os.path.join(arguments.report_dir, "results.h5")) as results:
        best = fastest(results["flutter"], arguments.friction)
        if best is None:
            sys.exit("plot_mode: no unstable mode in results.h5")
        group, name, eigenvalue = best
        real = numpy.asarray(results["flutter"][group][name + "_real"])
        imaginary = numpy.asarray(results["flutter"][group][name + "_imaginary"])
        coordinates = numpy.asarray(results["mesh"]["coordinates"])
        faces = boundary(results["mesh"])
    amplitude = numpy.sqrt((real**2 + imaginary**2).sum(axis=1))
    size = (coordinates.max(axis=0) - coordinates.min(axis=0)).max()
    deformed = coordinates.copy()
    deformed[:, : real.shape[1]] += 0.05 * size * real / amplitude.max()
    polygons = [deformed[face] for face in faces]
    values = numpy.array([amplitude[face].mean() for face in faces]) / amplitude.max()
    figure = pyplot.figure(figsize=(9, 6.5))
    axes = figure.add_subplot(projection="3d")
    colours = matplotlib.colormaps["viridis"](values)
    axes.add_collection3d(Poly3DCollection(polygons, facecolors=colours, edgecolors=(0, 0, 0, 0.15), linewidths=0.2))
    centre = 0.5 * (coordinates.max(axis=0) + coordinates.min(axis=0))
    axes.set(xlim=centre[0] + 0.36 * size * numpy.array([-1, 1]), ylim=centre[1] + 0.36 * size * numpy.array([-1, 1]),
             zlim=centre[2] + 0.36 * size * numpy.array([-1, 1]))
    axes.set_box_aspect((1, 1, 1))
    axes.view_init(elev=38, azim=-30)
    axes.set_axis_off()
    figure.colorbar(matplotlib.cm.ScalarMappable(cmap="viridis"), ax=axes, shrink=0.55, label="amplitude, relative")
    axes.set_title(f"{eigenvalue[1] / (2 * numpy.pi):.0f} Hz, growth {eigenvalue[0]:.0f} 1/s at friction {group.split('_')[1]}", y=0.95)
    output = arguments.output or os.path.join(arguments.report_dir, "mode.png")
    where, name = os.path.split(output)
    if os.path.realpath(where) == os.path.realpath(arguments.report_dir):
        added.save(name, figure, dpi=80, bbox_inches="tight")
    else:
        figure.savefig(output, dpi=80, bbox_inches="tight")
    print(output)


if __name__ == "__main__":
    main()
