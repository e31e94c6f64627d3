# SPDX-License-Identifier: BSD-2-Clause
"""CalculiX as a reference: decks of its package, changed so that they can be compared, and run."""
import gzip
import re
import subprocess
from pathlib import Path

import numpy as np

FOLDER = Path("/usr/share/doc/calculix-ccx-test/examples/test")
OUTPUT = ("NODEPRINT", "NODEFILE", "NODEOUTPUT", "ELPRINT", "ELFILE", "ELEMENTOUTPUT")
EIGENVALUES = "E I G E N V A L U E   O U T P U T"
ALL = "SQUEALALL"  # a set of all nodes


def deck_text(name):
    """Returns the text of a deck of the package."""
    path = FOLDER / f"{name}.inp"
    if path.is_file():
        return path.read_text(encoding="latin-1")
    return gzip.decompress((FOLDER / f"{name}.inp.gz").read_bytes()).decode("latin-1")


def _lines(text):
    """Yields each line, the keyword of its card without blanks, and whether it is the keyword line.
    Comments belong to the card before them."""
    keyword = ""
    for line in text.splitlines():
        word = line.strip().upper()
        first = word.startswith("*") and not word.startswith("**")
        if first:
            keyword = word[1:].replace(" ", "").split(",")[0]
        yield line, keyword, first


def comparable(text, full):
    """Returns a deck without large displacements; `full`: with C3D20 in place of C3D20R."""
    lines = []
    for line, keyword, first in _lines(text):
        if first and keyword == "STEP":
            line = re.sub(r",\s*NLGEOM", "", line, flags=re.IGNORECASE)
        if first and keyword == "ELEMENT" and full:
            line = re.sub(r"C3D20R", "C3D20", line, flags=re.IGNORECASE)
        lines.append(line)
    return "\n".join(lines) + "\n"


def printing(text):
    """Returns a deck that prints displacements and forces of all nodes, in global axes, in place of
    its own output."""
    last = max(_numbers_of_nodes(text))
    lines = [f"*NSET,NSET={ALL},GENERATE", f"1,{last}"]
    for line, keyword, first in _lines(text):
        if first and keyword == "STATIC":  # before it, as a line of increments may follow
            lines += [f"*NODE PRINT,NSET={ALL},GLOBAL=YES", "U,RF"]
        if keyword not in OUTPUT:
            lines.append(line)
    return "\n".join(lines) + "\n"


def held_elsewhere(text, supported):
    """Returns a deck that holds all nodes except the supported ones. There it prints the loads on
    supported nodes, which the forces of the deck itself contain next to the reactions."""
    numbers = _numbers_of_nodes(text) - set(supported)
    lines = []
    for line, keyword, first in _lines(text):
        if first and keyword == "STEP":
            lines += ["*BOUNDARY", *(f"{number},1,3" for number in sorted(numbers))]
        if keyword != "BOUNDARY":
            lines.append(line)
    return "\n".join(lines) + "\n"


def _numbers_of_nodes(text):
    return {
        int(line.split(",")[0])
        for line, keyword, first in _lines(text)
        if keyword == "NODE" and not first and re.match(r"\s*\d", line)
    }


class Reference:
    """Displacements and forces by node at the end of the last static step, and frequencies."""

    def __init__(self, text, folder):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "deck.inp").write_text(printing(text), encoding="latin-1")
        words = {"capture_output": True, "text": True, "errors": "replace", "check": False}
        run = subprocess.run(["ccx", "deck"], cwd=folder, **words)
        self.log = run.stdout
        data = folder / "deck.dat"
        output = data.read_text() if data.exists() else ""
        if run.returncode or "*ERROR" in run.stdout or not output.strip():
            raise AssertionError(f"ccx failed in {folder}: {run.stdout[-2000:]}")
        static = output.split(EIGENVALUES)[0]  # afterwards come mode shapes
        self.displacements = _table(static, "displacements")
        self.forces = _table(static, "forces")
        self.frequencies = _frequencies(output)


def _table(output, word):
    """Returns the last table of a quantity as {node: vector}."""
    parts = re.split(rf"^ {word} \(.*$", output, flags=re.MULTILINE)
    if len(parts) == 1:
        return {}
    rows = {}
    for line in parts[-1].splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            rows[int(words[0])] = np.array([float(one) for one in words[1:]])
        elif words:
            break
    return rows


def _frequencies(output):
    """Returns the frequencies in Hz of the last list of eigenvalues."""
    parts = output.split(EIGENVALUES)
    if len(parts) == 1:
        return np.zeros(0)
    found = []
    for line in parts[-1].splitlines():
        words = line.split()
        if len(words) == 5 and words[0].isdigit():
            found.append(float(words[3]))
        elif found and words:
            break
    return np.array(found)
