# SPDX-License-Identifier: BSD-2-Clause
"""Draws a complex mode, by VTK.

The picture shows the boundary of the mesh, deformed by the real part of the mode and coloured by
its amplitude, and the edges of the undeformed mesh.
"""
import argparse
import os
import shutil
import sys

from squeal.files import ResultsError
from squeal.folder import Folder
from squeal.results import Results


def chosen_mode(results, friction=None, number=None):
    """The mode of this number, or the fastest growing one whose shape was stored."""
    at = {} if friction is None else {"friction": friction}
    if number is not None:
        return results.mode(number, **at)
    mode = results.fastest_mode(**at)
    if mode is None:
        where = "" if friction is None else f" at friction {friction:g}"
        raise ResultsError(f"{results.folder / 'results.h5'}: no shape of a mode was kept{where}")
    return mode


def require_screen():
    """Starts the command again under xvfb-run if there is no screen: VTK opens a window."""
    if os.environ.get("DISPLAY"):
        return
    if not shutil.which("xvfb-run"):
        raise ResultsError("there is no screen, and xvfb-run (package xvfb) is not installed")
    os.execvp("xvfb-run", ["xvfb-run", "-a", *sys.orig_argv])


def write(folder, mode, grid, output):
    """Writes the picture of a mode; lists it in the manifest if it is in the folder of the run."""
    from squeal.plot.picture import write_picture  # it imports the windows of VTK

    title = (
        f"{mode.frequency:.6g} Hz, growth {mode.growth:.4g} 1/s at friction {mode.at['friction']:g}"
    )
    where, name = os.path.split(output)
    if os.path.realpath(where) == os.path.realpath(folder.path):
        folder.write(name, lambda path: write_picture(grid, title, path))
    else:
        write_picture(grid, title, output)


def main(words):
    parser = argparse.ArgumentParser(prog="squeal-plot mode", description="Draws a complex mode.")
    parser.add_argument("report_dir", metavar="DIR")
    parser.add_argument("friction", nargs="?", type=float, metavar="FRICTION")
    parser.add_argument("-m", "--mode", type=int, help="its number in the list of a point")
    parser.add_argument("-o", "--output", metavar="FILE.png", help="default: DIR/mode.png")
    arguments = parser.parse_args(words)
    folder = Folder(arguments.report_dir)
    mode = chosen_mode(Results(arguments.report_dir), arguments.friction, arguments.mode)
    grid = mode.grid()
    require_screen()
    output = arguments.output or os.path.join(arguments.report_dir, "mode.png")
    write(folder, mode, grid, output)
    print(output)
