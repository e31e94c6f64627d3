# SPDX-License-Identifier: BSD-2-Clause
"""The report of a run: one HTML file that opens offline in a browser."""
import base64
import html
import os
import sys
import zlib
from pathlib import Path

import matplotlib
import numpy as np

from squeal import regime
from squeal.files import ResultsError, open_regular
from squeal.folder import Folder
from squeal.keys import PARAMETERS
from squeal.page import WEB, columns, data_text, fill, script_element
from squeal.results import Results
from squeal.skin import Skin
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
    "plots",
    "selection",
    "table",
    "shape",
    "fields",
    "regime",
    "sections",
    "report",
)
MOST_BYTES = 22_000_000  # of the skin, fields and shapes in the file
SMALL = 1e-300


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


def _blob(array):
    return base64.b64encode(zlib.compress(np.ascontiguousarray(array).tobytes(), 9)).decode()


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
        _add_shapes(results, kept, data, blobs)
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


def _add_shapes(results, kept, data, blobs):
    mesh = results.mesh
    skin = Skin(mesh)
    places = np.pad(mesh.coordinates, ((0, 0), (0, 3 - mesh.coordinates.shape[1])))[skin.nodes]
    low, high = places.min(axis=0), places.max(axis=0)
    size = max((high - low).max(), SMALL)
    blobs["places"] = _blob(np.round((places - (low + high) / 2) / size * 65534).astype(np.int16))
    blobs["triangles"] = _blob(skin.triangles.astype(np.uint32))
    blobs["lines"] = _blob(skin.lines.astype(np.uint32))
    touching, fields, points = _contact(results, skin)
    blobs["touching"] = _blob(np.flatnonzero(touching).astype(np.uint32))
    blobs["steady"] = _blob(fields.astype(np.float32))
    every = len(points)
    while len(blobs["steady"]) > MOST_BYTES // 4 and len(points) > 1:
        fields, points = fields[::2], points[::2]
        blobs["steady"] = _blob(fields.astype(np.float32))
    if len(points) < every:
        data["left"].append(
            f"Contact fields are shown at {len(points)} of the {every} points of the sweep: the"
            " file would be too large."
        )
    data["skin"] = {
        "nodes": len(skin.nodes),
        "size": size,
        "bodies": skin.bodies,
        "touching": int(touching.sum()),
        "steady": points,
    }
    total = sum(len(text) for text in blobs.values())
    order = kept.sort_values("growth_rate_1_per_s", ascending=False)
    for row in order.itertuples():
        mode = results.mode(int(row.mode), **{name: getattr(row, name) for name in PARAMETERS})
        shape = np.pad(mode.shape, ((0, 0), (0, 3 - mode.shape.shape[1])))
        largest = max(np.abs(np.concatenate([shape.real, shape.imag])).max(), SMALL)
        parts = np.concatenate([shape.real[skin.nodes], shape.imag[skin.nodes]], axis=1) / largest
        text = _blob(np.round(127 * parts).astype(np.int8))
        worked = mode.friction_work is not None and touching.any()
        work = (
            _blob(mode.friction_work[skin.nodes[touching], 1].astype(np.float32)) if worked else ""
        )
        total += len(text) + len(work)
        if total > MOST_BYTES:
            data["left"].append(
                f"The shapes of {len(order) - len(data['shapes'])} slower growing modes were left"
                " out: the file would be too large."
            )
            break
        name = f"shape{len(data['shapes'])}"
        blobs[name] = text
        entry = {
            "blob": name,
            "mode": int(row.mode),
            "at": [float(getattr(row, key)) for key in PARAMETERS],
            "work": None,
        }
        if work:
            blobs[name + "work"] = work
            entry["work"] = name + "work"
        data["shapes"].append(entry)
    if skin.detail:
        data["left"].append(
            f"The surface has {skin.whole} triangles and is drawn with {len(skin.triangles)}, on"
            f" {len(skin.nodes)} of its nodes: details below {skin.detail:.2g} m are not seen."
        )
    if skin.unseen:
        data["left"].append(f"Bodies that are smaller are not drawn: {', '.join(skin.unseen)}.")
    if any(kind in (9, 10, 11, 12, 13, 14, 16, 17, 18, 19) for kind in mesh.cells):
        data["left"].append("Nodes amid the edges of cells are not drawn.")
    data["left"].append(
        "Shapes are drawn to 1/127 of their largest displacement, places to 1/65534 of the size of"
        " the brake."
    )


def _contact(results, skin):
    """Returns which nodes of the skin are contact nodes, pressure and gap as [point, 2, contact
    node], and the parameters of the points."""
    touching, fields, points = np.zeros(len(skin.nodes), bool), [], []
    for at in results.points.to_dict("records"):
        try:
            field = results.fields(**at).get("contact_pressure_gap")
        except ResultsError:  # a point without steady sliding
            continue
        if field is not None and field.shape[1] >= 2:
            touching |= np.any(field[skin.nodes] != 0, axis=1)
            fields.append(field[skin.nodes, :2])  # not the whole field: there may be many points
            points.append([at[name] for name in PARAMETERS])
    if not fields:
        return touching, np.zeros((0, 2, 0)), []
    return touching, np.stack([field[touching].T for field in fields]), points


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
