# SPDX-License-Identifier: BSD-2-Clause
"""Small results of runs, written without the program."""
import json
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np
import pandas as pd

HZ = 2j * np.pi
# A bar of two hexahedra, 1 m and 3 m long, of cross-section 1 m²: four nodes at x = 0, 1 and 4 m.
PLACES = np.array(
    [(x, y, z) for x in (0, 1, 4) for y, z in ((0, 0), (1, 0), (1, 1), (0, 1))], float
)
CELLS = np.array([[0, 4, 5, 1, 3, 7, 6, 2], [4, 8, 9, 5, 7, 11, 10, 6]])
ALONG = np.zeros((12, 3)) + [1, 0, 0]
# As ALONG, but against x at 4 m: nodal volumes 0.5 and 2 m³ move along, 1.5 m³ against it.
AGAINST = ALONG * np.where(PLACES[:, :1] == 4, -1, 1)
ACROSS = np.zeros((12, 3)) + [0, 1, 0]


def write(folder, points, **more):
    """Writes results. `points`: for each friction the modes (s, verdict[, shape]). `more`: tops of
    the bands by friction, options, critical frictions (friction, error, Hz), free modes (Hz,
    shape), order of the nodes, a stretch of the mesh, complete."""
    folder.mkdir()
    order = more.get("order", np.arange(12))
    options = {"flutter_friction": ",".join(map(str, points)), **more.get("options", {})}
    (folder / "options.txt").write_text(
        "\n".join(["# squeal 0.1.0, 1 ranks", *(f"-{name} {v}" for name, v in options.items())])
    )
    tops, entries, rows, states = more.get("tops", {}), [], [], []
    with h5py.File(folder / "results.h5", "w") as file:
        mesh = file.create_group("mesh")
        mesh.attrs["bodies"] = np.bytes_(b"bar")
        mesh["coordinates"] = (PLACES * more.get("stretch", 1.0))[order]
        mesh["node_tag"] = (10 + order)[:, None]
        mesh["cells_5/nodes"] = np.argsort(order)[CELLS]
        mesh["cells_5/body"] = mesh["cells_5/tag"] = np.zeros((2, 1), int)
        for friction, modes in points.items():
            at = {"friction": friction, "speed": 1, "pressure": 1, "damping": 1}
            group = file.create_group(f"flutter/friction_{friction:g}")
            group.attrs.update({name: float(value) for name, value in at.items()})
            for number, (s, verdict, *shape) in enumerate(modes, 1):
                rows.append(
                    {
                        **at,
                        "mode": number,
                        "growth_rate_1_per_s": s.real,
                        "angular_frequency_rad_per_s": s.imag,
                        "frequency_hz": s.imag / (2 * np.pi),
                        "damping_ratio": -s.real / abs(s),
                        "error_estimate": more.get("error", 1e-9),
                        "verdict": verdict,
                        "unstable": int(verdict == "unstable"),
                    }
                )
                if shape:
                    group[f"mode_{number:03d}_real"] = np.real(shape[0])[order]
                    group[f"mode_{number:03d}_imaginary"] = np.imag(shape[0])[order]
            worst = max((s.real for s, *_ in modes), default=np.nan)
            grows = [number for number, mode in enumerate(modes, 1) if mode[1] == "unstable"]
            entries.append(
                {
                    **at,
                    "eigenvalues": len(modes),
                    "band_top_hz": tops.get(friction, 1000.0),
                    "unstable_modes": [{"mode": number} for number in grows],
                }
            )
            states.append(
                {
                    **at,
                    "unstable_modes": len(grows),
                    "largest_growth_rate_1_per_s": worst,
                    "frequency_hz": 1,
                    "verdict": modes[0][1],
                    "undecided_modes": 0,
                }
            )
        for number, (hertz, shape) in enumerate(more.get("free", ()), 1):
            file[f"modes/active_set_1/mode_{number:03d}"] = shape[order]
    tables = {"eigenvalues": rows, "stability_map": states}
    tables["modes"] = [
        {"mode": k, "angular_frequency_rad_per_s": 2 * np.pi * hertz, "frequency_hz": hertz}
        for k, (hertz, _) in enumerate(more.get("free", ()), 1)
    ]
    tables["critical"] = [
        {
            "active_set": 1,
            "kind": "hopf",
            "direction": "loss",
            **dict(at, friction=friction),
            "frequency_hz": hertz,
            "friction_error_estimate": error,
        }
        for friction, error, hertz in more.get("critical", ())
    ]
    for name, table in tables.items():
        if table:
            pd.DataFrame(table).to_csv(folder / f"{name}.csv", index=False, na_rep="nan")
    summary = {"version": "0.1.0", "case": "bar", "complete": more.get("complete", True)}
    summary |= {"frictions": entries, "options": options}
    summary["verdict"] = {"sentence": "Known."}
    (folder / "summary.json").write_text(json.dumps(summary))
    return folder


class OnWrittenResults(unittest.TestCase):
    """Results that a test writes into a folder of its own."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.place = Path(temporary.name)

    def write(self, name, points, **more):
        return write(self.place / name, points, **more)
