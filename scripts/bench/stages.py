# SPDX-License-Identifier: BSD-2-Clause
"""Called by scripts/bench/stages with the floors of the runs, in seconds, and their summaries."""
import json
import statistics
import sys

floors = [float(word) for word in sys.argv[1].split()]
runs = [json.load(open(path)) for path in sys.argv[2:]]
first = runs[0]
print(
    f"\n{first['case']}: {first['dofs']} unknowns, {first['ranks']} ranks,"
    f" {len(first['frictions'])} points of the sweep"
)
rows = []
for run, floor in zip(runs, floors):
    stages = {name: stage["wall_s"] for name, stage in run["stages"].items()}
    vibration, whole = stages["factor"] + stages["modes"], sum(stages.values())
    memory = max(stage["peak_memory_bytes"] for stage in run["stages"].values())
    rows.append(
        {
            **stages,
            "floor": floor,
            "free vibration": vibration,
            "free vibration / floor": vibration / floor,
            "steady / floor": stages["steady"] / floor,
            "whole run": whole,
            "whole run / floor": whole / floor,
            "memory, GB": 1e-9 * memory,
        }
    )
for name in rows[0]:
    values = [row.get(name, 0) for row in rows]
    print(
        f"  {name:24s} median {statistics.median(values):8.2f}   runs "
        + " ".join(f"{value:.2f}" for value in values)
    )
print(
    "real solves for corrections and error estimates:"
    f" {sum(entry['solves'] for entry in first['active_sets'])}"
)
print(
    "sparse work: "
    + ", ".join(f"{count} {name.replace('_', ' ')}" for name, count in first["sparse_work"].items())
)
