# SPDX-License-Identifier: BSD-2-Clause
"""Made tables of shares and participation for the stored modes of a run."""
import numpy as np

from changed_tables import reshape
from squeal.keys import PARAMETERS

COLUMNS = (
    "damping_1_per_s follower_1_per_s friction_damping_1_per_s law_slope_1_per_s"
    " convective_1_per_s gyroscopic_1_per_s"
).split()
HEAD = [*PARAMETERS, "mode", "growth_rate_1_per_s", "frequency_hz"]

SHARES = ["strain_share", "kinetic_share", "motion", "motion_share"]
PHASOR = ["amplitude", "phase_deg"]
TABLES = ("components", "participation")


def write(folder, results, names):
    """Writes both tables, in place of those of the run: `names` lists (kind, component)."""
    kept = results.kept_modes()
    random = np.random.default_rng(1)
    components, participation = [], []
    for row in kept.itertuples():
        head = [getattr(row, name) for name in PARAMETERS]
        head += [int(row.mode), row.growth_rate_1_per_s, row.frequency_hz]
        strain, kinetic = random.dirichlet(np.full(len(names), 0.4), 2)
        parts = _contributions(random, names, row.growth_rate_1_per_s)
        for k, (kind, name) in enumerate(names):
            components.append([*head, kind, name, strain[k], kinetic[k], "", "", *parts[k]])
        shares = np.sort(random.dirichlet(np.full(13, 0.5)))[::-1]
        for k, share in enumerate(shares):
            free = 0 if k == 12 else 20 + k
            frequency = "" if k == 12 else row.frequency_hz + 10 * k
            participation.append(
                [*head, free, frequency, share, share**2, *([0.5, 0] if frequency else ["", ""])]
            )
    _save(
        folder / "components.csv",
        [*HEAD, "kind", "component", *SHARES, *COLUMNS],
        components,
    )
    _save(
        folder / "participation.csv",
        [*HEAD, "free_mode", "free_frequency_hz", "energy_share", "mac", *PHASOR],
        participation,
    )
    reshape(folder)


def write_component_modes(folder, rows):
    """Writes the modes of bodies by themselves: `rows` lists (body, mode, Hz, motion, share)."""
    head = ["body", "mode", "frequency_hz", "motion", "motion_share"]
    quoted = [[*row[:3], f'"{row[3]}"' if row[3] else "", row[4]] for row in rows]
    _save(folder / "component_modes.csv", head, quoted)


def _contributions(random, names, growth):
    """Terms of components that add up to the growth rate: bodies damp, interfaces feed."""
    parts = np.zeros((len(names), len(COLUMNS)))
    for k, (kind, _) in enumerate(names):
        if kind == "interface":
            parts[k, 1:3] = abs(growth) * np.array([1.5, -0.2])
        else:
            parts[k, 0] = -abs(growth) * random.uniform(0, 0.1)
    first = next(k for k, (kind, _) in enumerate(names) if kind == "interface")
    parts[first, 1] += growth - parts.sum()
    return parts


def _save(path, head, rows):
    lines = [",".join(map(str, line)) for line in [head, *rows]]
    path.write_text("\n".join(lines) + "\n")


__all__ = ["COLUMNS", "TABLES", "write", "write_component_modes"]
