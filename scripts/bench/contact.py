# SPDX-License-Identifier: BSD-2-Clause
"""Called by scripts/bench/contact: reads summary.json of the runs and prints the figures."""
import json
import sys

print("| contact nodes | open | unknowns | factor, s | steady, s | right-hand sides | memory, GB |")
print("|" + "---:|" * 7)
for folder in sys.argv[1:]:
    summary = json.load(open(folder + "/summary.json"))
    stages = summary["stages"]
    opened = summary["active_sets"][0]["open_nodes"]
    print(
        f"| {summary['contact_nodes']:,} | {opened:,} | {summary['dofs']:,}"
        f" | {stages['factor']['wall_s']:.1f} | {stages['steady']['wall_s']:.1f}"
        f" | {summary['sparse_work']['right_hand_sides']:,}"
        f" | {1e-9 * stages['steady']['peak_memory_bytes']:.2f} |"
    )
