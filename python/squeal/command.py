# SPDX-License-Identifier: BSD-2-Clause
"""Starts the commands squeal-plot, squeal-report, squeal-merge, squeal-compare, squeal-import."""
import importlib
import sys

from squeal.files import ResultsError

# Debian's packages of the Python packages that the commands import.
PACKAGES = {name: f"python3-{name}" for name in ("h5py", "matplotlib", "numpy", "pandas", "scipy")}
PACKAGES["vtkmodules"] = "python3-vtk9"


def run(module, name):
    """Calls main(words) of a module with the words of the command line. The command reports an
    error of the results, or a missing Python package, in one line and exits with code 1."""
    try:
        importlib.import_module(module).main(sys.argv[1:])
    except ResultsError as error:
        sys.exit(f"{name}: {error}")
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in PACKAGES:
            raise
        sys.exit(
            f"{name}: Python's package {package} is not installed; "
            f"Debian has it in {PACKAGES[package]}"
        )
