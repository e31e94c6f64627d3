# SPDX-License-Identifier: BSD-2-Clause
"""The report of a run: one HTML file that opens offline in a browser."""
import base64
import html
import os
import sys
from pathlib import Path

import matplotlib
import numpy as np

from squeal import regime
from squeal.files import open_regular
from squeal.folder import Folder
from squeal.keys import PARAMETERS
from squeal.page import WEB, columns, data_text, fill, script_element
from squeal.results import Results
from squeal.shapes import add_shapes
from squeal.verdict import certificate, verdict

# Debian's packages libjs-three and libjs-chart.js: program, controls of the view, licences.
SCRIPTS = {
    "three.js": (
        "/usr/share/javascript/three/three.min.js",
        "/usr/share/doc/libjs-three/copyright",
    ),
    "its orbit controls": (
        "/usr/share/javascript/three/examples/js/controls/OrbitControls.js",
        None,
    ),
    "Chart.js": (
        "/usr/share/javascript/chart.js/chart.min.js",
        "/usr/share/doc/libjs-chart.js/copyright",
    ),
}
# Of web/, in the order in which the browser runs them: the last one starts the report.
OWN_SCRIPTS = (
    "basics",
    "state",
    "svg",
    "figures",
    "plots",
    "stability",
    "bars",
    "shares",
    "changes",
    "criticals",
    "linings",
    "selection",
    "table",
    "shape",
    "bodies",
    "fields",
    "regime",
    "judged",
    "sections",
    "print",
    "report",
)
# Columns that are in the table of the eigenvalues.
REPEATED = ("growth_rate_1_per_s", "frequency_hz")


def build(results):
    """Returns the text of the HTML file."""
    libraries, licences = _libraries()
    data, blobs = _data(results, with_shapes=bool(libraries))
    own = [(WEB / f"{name}.js").read_text() for name in OWN_SCRIPTS] if libraries else []
    parts = {
        "title": html.escape(f"{data['case']}: brake squeal"),
        "style": (WEB / "report.css").read_text(),
        "verdict": html.escape(data["verdict"]),
        "certificate": "".join(f"<li>{html.escape(line)}</li>" for line in data["certificate"]),
        "data": data_text(data),
        "blobs": "\n".join(
            f'<script type="application/octet-stream" id="blob-{name}">{text}</script>'
            for name, text in blobs.items()
        ),
        "libraries": "\n".join(map(script_element, libraries)),
        "scripts": "\n".join(map(script_element, own)),
        "pictures": _after_flutter(results) + _pictures(results) if not libraries else "",
        "licences": "".join(
            f"<h3>{html.escape(name)}</h3><pre>{html.escape(text)}</pre>" for name, text in licences
        ),
    }
    return fill("report.html", parts)


def _libraries():
    """Returns the libraries and their licences; neither if a library is missing."""
    if any(not Path(program).exists() for program, _ in SCRIPTS.values()):
        return [], []
    programs = [Path(program).read_text() for program, _ in SCRIPTS.values()]
    return programs, [
        (name, Path(text).read_text())
        for name, (_, text) in SCRIPTS.items()
        if text and Path(text).exists()
    ]


def _pictures(results):
    """Returns the pictures of the folder, for a report without libraries."""
    found = (
        sorted(results.folder.glob("stability*.png"))
        + sorted(results.folder.glob("mode*.png"))
        + sorted(results.folder.glob("regime.png"))
    )
    images = "".join(
        f'<img alt="{html.escape(path.stem)}"'
        f' src="data:image/png;base64,{base64.b64encode(_bytes_of(path)).decode()}">'
        for path in found
    )
    return (
        "<p class=note>Diagrams and modes cannot be turned here: the libraries three.js and"
        " Chart.js were not installed when the report was made (packages libjs-three,"
        f" libjs-chart.js).</p>{images}"
    )


def _bytes_of(path):
    with os.fdopen(open_regular(path), "rb") as file:
        return file.read()


def _after_flutter(results):
    """Returns sentences on the motion after flutter, for a report without libraries."""
    return "".join(f"<p>{html.escape(line)}</p>" for line in regime.sentences(results))


def _data(results, with_shapes):
    summary, eigenvalues = results.summary, results.eigenvalues
    kept = results.kept_modes()
    data = {
        "case": results.folder.resolve().name,
        "version": summary.get("version", ""),
        "verdict": " ".join([verdict(results), *_notes(results)]),
        "certificate": certificate(results),
        "parameters": list(PARAMETERS),
        "swept": results.swept(),
        "bandHz": max(
            (point.get("band_top_hz") or 0 for point in summary.get("frictions", [])), default=0
        ),
        "points": columns(results.stability_map),
        "eigenvalues": columns(eigenvalues),
        "branches": columns(results.branches),
        "critical": columns(results.critical),
        "frictionWork": columns(results.friction_work),
        "sensitivities": columns(results.sensitivities),
        "criticalSensitivities": columns(results.critical_sensitivities),
        "components": columns(results.table("components"), REPEATED),
        "participation": columns(results.table("participation"), REPEATED),
        "componentModes": columns(results.component_modes),
        "proof": columns(results.table("proof")),
        "judged": columns(results.table("referee")),
        "steady": _steady_forces(summary),
        "regimes": regime.diagrams(results),
        "stages": {
            name: [stage.get("wall_s", 0), stage.get("peak_memory_bytes", 0)]
            for name, stage in summary.get("stages", {}).items()
        },
        "wallSeconds": summary.get("wall_s", 0),
        "sizes": {
            name: summary[name]
            for name in ("ranks", "nodes", "cells", "contact_nodes", "dofs")
            if name in summary
        },
        "options": {name: str(value) for name, value in summary.get("options", {}).items()},
        "colours": [
            [round(255 * part) for part in colour[:3]]
            for colour in matplotlib.colormaps["viridis"](np.linspace(0, 1, 32))
        ],
        "shapes": [],
        "linings": [],
        "skin": None,
        "left": [],
    }
    blobs = {}
    if results.parts:
        folders = ", ".join(part["folder"] for part in results.summary["parts"])
        data["left"].append(
            "These are the joined tables of several runs. Shapes of modes and contact fields are"
            f" in the reports of each: {folders}."
        )
    elif with_shapes and results.mesh is not None and len(kept):
        add_shapes(results, kept, data, blobs)
    elif with_shapes and results.mesh is None:
        data["left"].append("Matrices from files have no mesh, so that no shapes are shown.")
    elif with_shapes:
        data["left"].append("No shape of an unstable mode was kept (-flutter_shapes).")
    return data, blobs


def _steady_forces(summary):
    """Returns the forces of steady sliding, a row for each point and interface."""
    rows = []
    for point in summary.get("frictions", []):
        for name, found in (point.get("steady") or {}).get("interfaces", {}).items():
            normal, friction = (
                np.linalg.norm(found.get(key) or [0])
                for key in ("normal_force_n", "friction_force_n")
            )
            rows.append(
                [
                    *(point[key] for key in PARAMETERS),
                    name,
                    float(normal),
                    float(friction),
                    point["steady"].get("open_nodes", 0),
                ]
            )
    return rows


def _notes(results):
    """Returns the remark of the user (-report_note) as a sentence, if there is one."""
    note = results.summary.get("options", {}).get("report_note", "none")
    return [] if note == "none" else [f"Note: {note.rstrip('.')}."]


HELP = """squeal-report DIR: writes report.html into the folder of results DIR.

The report is one file that any browser opens without a network."""


def main(words):
    if words in (["-h"], ["--help"]):
        print(HELP)
        return
    if len(words) != 1 or words[0].startswith("-"):
        sys.exit(HELP)
    folder = Folder(words[0])
    print(folder.save_text("report.html", build(Results(words[0]))))


__all__ = ["build", "certificate", "main", "verdict"]
