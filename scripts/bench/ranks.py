# SPDX-License-Identifier: BSD-2-Clause
"""Called by scripts/bench/ranks: reads summary.json of the runs and prints the figures."""
import json
import statistics
import sys

columns = {}
for setting in sys.argv[3:]:
    ranks, threads = setting.split()
    runs = [
        json.load(open(f"{sys.argv[1]}/benchmark_ranks_{ranks}_{threads}_{i}/summary.json"))[
            "stages"
        ]
        for i in range(1, int(sys.argv[2]) + 1)
    ]
    column = {name: statistics.median(run[name]["wall_s"] for run in runs) for name in runs[0]}
    column["all"] = statistics.median(
        sum(stage["wall_s"] for stage in run.values()) for run in runs
    )
    column["memory, GB"] = max(stage["peak_memory_bytes"] for stage in runs[0].values()) * 1e-9
    columns[f"{ranks} × {threads}"] = column
print("| ranks × BLAS threads | " + " | ".join(columns) + " |")
print("|---|" + "---:|" * len(columns))
for name in next(iter(columns.values())):
    print(f"| {name} | " + " | ".join(f"{column[name]:.2f}" for column in columns.values()) + " |")
