# SPDX-License-Identifier: BSD-2-Clause
"""Called by scripts/bench/opening: reads summary.json of the runs and prints the figures."""
import json
import statistics
import sys

folder, repeats = sys.argv[1], int(sys.argv[2])
summaries = {
    slope: [
        json.load(open(f"{folder}/benchmark_opening_{slope}_{i}/summary.json"))
        for i in range(1, repeats + 1)
    ]
    for slope in ("0.005", "0")
}
first = summaries["0"][0]
print(
    f"{first['nodes']} nodes, {first['ranks']} ranks, {len(first['frictions'])} frictions,"
    f" {len(first['active_sets'])} active sets where contact opens"
)


def share(run):
    stages = run["stages"]
    return stages["steady"]["wall_s"] / (stages["factor"]["wall_s"] + stages["modes"]["wall_s"])


for slope, runs in summaries.items():
    print(
        f"slope={slope}: {statistics.median(run['wall_s'] for run in runs):.2f} s, "
        f"steady / free vibration = {statistics.median(map(share, runs)):.3f}"
    )
pairs = zip(summaries["0"], summaries["0.005"])
print(
    f"slope=0 / slope=0.005 = {statistics.median(a['wall_s'] / b['wall_s'] for a, b in pairs):.2f}"
)
