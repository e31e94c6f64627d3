#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Flutter of a brake by CalculiX, whose contact is a penalty, and by this program, which imports
the same deck: test_brake.py PROGRAM [FINE]. Without calculix-ccx it is skipped (exit code 77).

A tangential stiffness across the sliding direction, and a mass that is integrated with four points,
remain in CalculiX however stiff the penalty is.
"""
import csv
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from ring_brake import deck

from squeal.deck.importer import import_deck

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(repository / "build/squeal")
FINE = int(sys.argv[2]) if len(sys.argv) > 2 else 1
PENALTIES = (3e13, 1e14, 1e15)  # N/m3; E / h of the lining is 7e11
FRICTION = 0.3
# The first one leaves the growth rates 2 % too small: the penalty is in series with the lining.
FREQUENCY, GROWTH = 1e-3, 5e-2


def timed(words, folder):
    """Runs a program and returns its processor time, s."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    run = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if run.returncode:
        raise AssertionError(f"{words[0]} failed: {run.stdout[-2000:]}{run.stderr[-2000:]}")
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return used, time.monotonic() - start


def by_calculix(folder, penalty):
    """Returns (frequency, growth rate) of the unstable modes, and the processor time."""
    (folder / "brake.inp").write_text(deck(FINE, penalty))
    seconds, _ = timed(["ccx", "brake"], folder)
    rows = (folder / "brake.dat").read_text().split("E I G E N V A L U E   O U T P U T")[-1]
    found = []
    for line in rows.splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit() and float(words[3]) > 0:
            found.append((float(words[2]), float(words[3])))
        elif words and words[0] == "P":  # participation factors
            break
    return found, seconds


def by_program(folder, penalty):
    (folder / "brake.inp").write_text(deck(FINE, penalty))
    import_deck(folder / "brake.inp", folder / "case", "calculix")
    words = [PROGRAM, "-options_file", "case/case.yaml", "-flutter_friction", str(FRICTION)]
    seconds, _ = timed([*words, "-quiet", "-report_dir", "results"], folder)
    with open(folder / "results/eigenvalues.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [
        (float(row["frequency_hz"]), float(row["growth_rate_1_per_s"]))
        for row in rows
        if row["verdict"] == "unstable"
    ], seconds


def main():
    with tempfile.TemporaryDirectory() as folder:
        ours, seconds = by_program(Path(folder), PENALTIES[-1])
        print(f"squeal, hard contact: {seconds:.1f} s of processor time", *_words(ours))
        assert len(ours) >= 2, "the brake is to have two unstable modes at least"
        errors = []
        for penalty in PENALTIES:
            theirs, seconds = by_calculix(Path(folder), penalty)
            print(f"ccx, penalty {penalty:g}: {seconds:.1f} s", *_words(theirs))
            top = theirs[-1][0] * (1 + FREQUENCY)  # the two lists may end at different modes
            expected = [one for one in ours if one[0] <= top][: len(theirs)]
            assert len(theirs) == len(expected) >= 1, (theirs, ours)
            errors.append(0.0)
            for (hertz, growth), (exact, rate) in zip(theirs, expected):
                assert abs(hertz - exact) <= FREQUENCY * exact, (hertz, exact)
                assert abs(growth - rate) <= GROWTH * rate, (growth, rate)
                errors[-1] = max(errors[-1], abs(growth / rate - 1))
        print("largest errors of the growth rates:", *(f"{error:.2%}" for error in errors))
        assert errors[0] > errors[1] > errors[2], "stiffer penalties come closer to hard contact"


def _words(modes):
    return [f"{hertz:.2f} Hz ({growth:.3f} 1/s)" for hertz, growth in modes]


if __name__ == "__main__":
    if shutil.which("ccx") is None:
        print("skipped: calculix-ccx is not installed")
        sys.exit(77)
    main()
