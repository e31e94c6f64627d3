# SPDX-License-Identifier: BSD-2-Clause
"""Called by scripts/bench/growth: reads summary.json of the runs and prints the figures."""
import json
import math
import sys

names = ["elasticity", "contact", "factor", "steady", "modes", "flutter", "track"]
rows = []
print("| unknowns | " + " | ".join(f"{name}, s" for name in names) + " | all, s | memory, GB |")
print("|" + "---:|" * (len(names) + 3))
for folder in sys.argv[1:]:
    summary = json.load(open(folder + "/summary.json"))
    stages = summary["stages"]
    seconds = sum(stage["wall_s"] for stage in stages.values())
    memory = max(stage["peak_memory_bytes"] for stage in stages.values())
    rows.append((summary["dofs"], seconds, memory))
    times = " | ".join(f"{stages[name]['wall_s']:.1f}" for name in names)
    print(f"| {summary['dofs']:,} | {times} | {seconds:.1f} | {1e-9 * memory:.2f} |")


def exponents(a, b):
    ratio = math.log(b[0] / a[0])
    return f"time {math.log(b[1] / a[1]) / ratio:.2f}, memory {math.log(b[2] / a[2]) / ratio:.2f}"


for a, b in zip(rows, rows[1:]):
    print(f"exponents from {a[0]:,} to {b[0]:,}: {exponents(a, b)}")
if len(rows) > 2:
    print(f"exponents from {rows[0][0]:,} to {rows[-1][0]:,}: {exponents(rows[0], rows[-1])}")
