# SPDX-License-Identifier: BSD-2-Clause
"""Tables of results that a test has changed."""
import csv
import json
from pathlib import Path


def reshape(folder, without=()):
    """Makes summary.json tell the rows and columns that the tables have now, as if a run had
    written them; tables `without` it wrote not."""
    path = Path(folder) / "summary.json"
    summary = json.loads(path.read_text())
    for name in list(summary["tables"]):
        if name in without:
            del summary["tables"][name]
            continue
        with open(Path(folder) / f"{name}.csv", newline="") as file:
            head, *rows = csv.reader(file)
        summary["tables"][name] = {"rows": len(rows), "columns": head}
    path.write_text(json.dumps(summary))
