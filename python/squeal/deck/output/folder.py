# SPDX-License-Identifier: BSD-2-Clause
"""The folder of an imported case."""
import re

from squeal.deck.journal import DeckError
from squeal.deck.output.options import MARK

PARTIAL = "mesh.msh.partial"  # the mesh gets its name when all is written
FILES = ("mesh.msh", "case.yaml", "import.md", "rows.csv", "omitted_rows.csv", PARTIAL)
MATRIX = re.compile(
    r"(stiffness|mass|damping|friction|friction_damping|gyroscopic)(_\d+)?\.petsc(\.partial)?"
)


def prepare(folder):
    """Makes the folder, and removes the files of an earlier import. Raises DeckError if a case is
    there that was not imported."""
    case = folder / "case.yaml"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if case.exists() and not case.read_text(encoding="utf-8", errors="replace").startswith(
            MARK
        ):
            raise DeckError(f"{case} was not made by squeal-import; choose another folder")
        files = [path for path in folder.iterdir() if _is_ours(path.name)]
        for path in [] if case.exists() else files:
            if path.name == "mesh.msh" or not (folder / "import.md").exists():
                raise DeckError(
                    f"{folder} has a {path.name} of another origin; choose another folder"
                )
        for path in files:
            path.unlink()
    except OSError as error:
        raise DeckError(f"{error.filename or folder}: {error.strerror}") from None


def _is_ours(name):
    return name in FILES or MATRIX.fullmatch(name) is not None
