# SPDX-License-Identifier: BSD-2-Clause
"""A run that several tests read, from copies of its folder."""
import shutil
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]


class MadeRun:
    """The run of a case of options/ with further options."""

    def __init__(self, case, options):
        self.options = {"options_file": REPOSITORY / f"options/{case}.yaml", **options}

    def make(self, program, folder):
        """Runs the case into a folder."""
        words = [word for name, value in self.options.items() for word in (f"-{name}", value)]
        subprocess.run(
            [program, *words, "-report_dir", folder, "-quiet"],
            check=True,
            stdout=subprocess.DEVNULL,
        )

    def place(self, program, made, folder):
        """Puts the results into `folder`: a copy of `made`, or a run if that is None."""
        if made is None:
            self.make(program, folder)
        else:
            shutil.copytree(made, folder)

    def main(self):
        """Runs the case of a script that is called with PROGRAM FOLDER."""
        shutil.rmtree(sys.argv[2], ignore_errors=True)
        self.make(*sys.argv[1:])
