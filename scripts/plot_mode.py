#!/usr/bin/python3 -B
"""Picture of a complex mode: plot_mode.py REPORT_DIR [FRICTION] [-m MODE] [-o FILE.png]

Draws the fastest growing mode whose shape was kept, at FRICTION if that is given, or MODE of the list of a point: the boundary of the
mesh, deformed by the real part of the mode, coloured by its amplitude, and its edges at rest. Rendered by VTK; without a screen under xvfb.
"""
import argparse
import os
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))

from results import Results, program  # noqa: E402, I001
import squeal  # noqa: E402


def mode_asked(run, arguments):
    at = {} if arguments.friction is None else {"friction": arguments.friction}
    if arguments.mode is not None:
        return run.mode(arguments.mode, **at)
    mode = run.fastest_mode(**at)
    if mode is None:
        where = "" if arguments.friction is None else f" at friction {arguments.friction:g}"
        raise squeal.ResultsError(f"{run.folder / 'results.h5'}: no shape of a mode was kept{where}")
    return mode


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("report_dir")
    parser.add_argument("friction", nargs="?", type=float)
    parser.add_argument("-m", "--mode", type=int)
    parser.add_argument("-o", "--output")
    arguments = parser.parse_args()
    added = Results(arguments.report_dir)
    try:
        mode = mode_asked(squeal.open(arguments.report_dir), arguments)
        grid = mode.grid()
    except squeal.ResultsError as error:
        sys.exit(f"{program()}: {error}")
    if not os.environ.get("DISPLAY"):
        if not shutil.which("xvfb-run"):
            sys.exit(f"{program()}: there is no screen, and xvfb-run (package xvfb) is not installed")
        os.execvp("xvfb-run", ["xvfb-run", "-a", *sys.orig_argv])
    from squeal.picture import write_picture  # it opens VTK's windows

    title = f"{mode.frequency:.6g} Hz, growth {mode.growth:.4g} 1/s at friction {mode.at['friction']:g}"
    output = arguments.output or os.path.join(arguments.report_dir, "mode.png")
    where, name = os.path.split(output)
    if os.path.realpath(where) == os.path.realpath(arguments.report_dir):
        added.write(name, lambda path: write_picture(grid, title, path))
    else:
        write_picture(grid, title, output)
    print(output)


if __name__ == "__main__":
    main()
