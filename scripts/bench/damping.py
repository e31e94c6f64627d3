# SPDX-License-Identifier: BSD-2-Clause
"""Called by scripts/bench/damping: reads summary.json of the runs and prints the figures."""
import json
import statistics
import sys

pairs = []
for i in range(1, int(sys.argv[2]) + 1):
    off, on = (
        json.load(open(f"{sys.argv[1]}/benchmark_damping_{word}_{i}/summary.json"))
        for word in ("off", "on")
    )
    pairs.append((off["stages"]["flutter"]["wall_s"], on["stages"]["flutter"]["wall_s"]))
    print(
        f"flutter without damping {pairs[-1][0]:.2f} s, with damping {pairs[-1][1]:.2f} s:"
        f" {pairs[-1][1] / pairs[-1][0]:.2f}"
    )
print(f"median {statistics.median(b / a for a, b in pairs):.2f}")
