# SPDX-License-Identifier: BSD-2-Clause
"""The effect of a change of a parameter: as the derivatives of a run predict it, and as a second
run computes it. squeal-run CASE -what_if NAME.QUANTITY=FACTOR makes both runs.

main(["check", WORD, …]) checks the words; ["options", FOLDER, WORD, …] prints the options that
change the run in FOLDER; ["compare", FOLDER, CHANGED, WORD, …] prints the comparison of both.
"""
import dataclasses
import re

import numpy as np

from squeal.files import ResultsError
from squeal.keys import PARAMETERS, words_of
from squeal.parts import recipe_of
from squeal.results import Results

GLOBAL = ("speed", "pressure", "damping")
LINEAR = 0.02  # of a change: what a prediction may miss
FAR = 0.05  # relative: a mode that moved further is not taken for the same


@dataclasses.dataclass(frozen=True)
class Change:
    """One word of the command line."""

    word: str
    name: str  # of a material, spring, bushing or mass; empty for a parameter of the sweep
    quantity: str
    factor: float


def changes_of(words):
    """Returns the changes that the words ask for."""
    found = []
    for word in words:
        match = re.fullmatch(r"(?:(\w+)\.)?(\w+)=([^=]+)", word)
        try:
            factor = float(match[3]) if match else np.nan
        except ValueError:
            factor = np.nan
        if not (np.isfinite(factor) and factor > 0 and factor != 1):
            raise ResultsError(
                f"-what_if {word}: it has the form NAME.QUANTITY=FACTOR, such as"
                " back_plate.young=1.01, or QUANTITY=FACTOR for speed, pressure or damping, with"
                " a factor > 0 that is not 1"
            )
        name, quantity = match[1] or "", match[2]
        if not name and quantity not in GLOBAL:
            raise ResultsError(
                f"-what_if {word}: {quantity} is the quantity of a body, spring, bushing or mass:"
                f" NAME.{quantity}={match[3]}; without a name there are {', '.join(GLOBAL)}"
            )
        found.append(Change(word, name, quantity, factor))
    if len({(one.name, one.quantity) for one in found}) < len(found):
        raise ResultsError("-what_if names a quantity twice")
    return found


# By the parameter of a sensitivity: options, and the places of Poisson's ratios in their values,
# which keep theirs.
SCALED = {
    "young_{}": {
        "material_{}_young": (),
        "material_{}_engineering_constants": (3, 4, 5),
        "material_{}_transverse": (2, 3),
        "material_{}_orthotropic": (),
        "material_{}_anisotropic": (),
    },
    "density_{}": {"material_{}_density": ()},
    "damping_{}": {
        "material_{}_rayleigh_mass": (),
        "material_{}_rayleigh_stiffness": (),
        "material_{}_loss_factor": (),
    },
    "spring_{}_stiffness": {"spring_{}_stiffness": ()},
    "spring_{}_damping": {"spring_{}_damping": ()},
    "bushing_{}_stiffness": {"bushing_{}_stiffness": ()},
    "bushing_{}_damping": {"bushing_{}_damping": ()},
    "mass_{}": {"mass_{}_total": (), "mass_{}_inertia": ()},
}


def parameter_of(change, known):
    """Returns the name that the tables of derivatives use for the parameter of a change."""
    if not change.name:
        return change.quantity
    for pattern in SCALED:
        parts = pattern.split("_")
        if change.quantity in (parts[0], parts[-1]) and (pattern.format(change.name) in known):
            return pattern.format(change.name)
    named = sorted(_word_of(name) for name in known if name not in PARAMETERS)
    raise ResultsError(
        f"-what_if {change.word}: the run has no derivative of {change.quantity} of"
        f" {change.name}; it has those of {', '.join(named)}"
    )


def _word_of(parameter):
    """Returns back_plate.young for young_back_plate, guide.stiffness for spring_guide_stiffness."""
    for pattern in SCALED:
        match = re.fullmatch(pattern.replace("{}", r"(\w+)"), parameter)
        if match:
            ends = [part for part in pattern.split("_") if part != "{}"]
            return f"{match[1]}.{ends[-1]}"
    return parameter


def derivatives_of(results):
    """The tables with derivatives of a run."""
    tables = [results.sensitivities, results.critical_sensitivities]
    if tables[0] is None:
        raise ResultsError(f"{results.folder} has no derivatives (-flutter_sensitivities)")
    return tables


def options_of(results, changes):
    """Returns the options of the changed run that differ, [(name, value)]."""
    given, values = recipe_of(results.folder / "options.txt")
    known = {
        name
        for table in derivatives_of(results)
        if table is not None
        for name in table["parameter"]
        if name != "none"
    }
    found = []
    for change in changes:
        parameter = parameter_of(change, known)
        if not change.name:
            name = f"flutter_{change.quantity}"
            found.append((name, _scaled_sweep(values[name], change.factor)))
            continue
        pattern = next(one for one in SCALED if one.format(change.name) == parameter)
        options = {
            option.format(change.name): kept
            for option, kept in SCALED[pattern].items()
            if option.format(change.name) in given
        }
        if not options:
            raise ResultsError(
                f"-what_if {change.word}: no option of the run gives this value; change"
                " those of the body of this section"
            )
        for name, kept in options.items():
            numbers = [float(word) for word in values[name].split(",")]
            scaled = [x if k in kept else x * change.factor for k, x in enumerate(numbers)]
            found.append((name, ",".join(f"{x:.17g}" for x in scaled)))
    return found


def _scaled_sweep(text, factor):
    separator = ":" if ":" in text else ","
    return separator.join(f"{float(word) * factor:.17g}" for word in text.split(separator))


def predicted(table, row, changes, column):
    """The change of a quantity by its derivatives; NaN if one is missing. `row` selects the rows of
    the quantity in a table of derivatives."""
    total = 0.0
    for change in changes:
        parameter = parameter_of(change, set(table["parameter"]) | set(GLOBAL))
        rows = table[row & (table["parameter"] == parameter)]
        if len(rows) != 1:
            return np.nan
        one = rows.iloc[0]
        size = one[change.quantity] if not change.name else 1.0
        total += one[column] * size * (change.factor - 1)
    return total


@dataclasses.dataclass
class Line:
    """One quantity: before, its predicted change, its change, and the error of both values."""

    place: str
    before: float
    predicted: float
    changed: float  # NaN: not found again
    error: float

    def verdict(self):
        """Whether the prediction holds, in words."""
        if np.isnan(self.predicted):
            return "no derivative"
        if np.isnan(self.changed):
            return "not found, or not solved for, in the changed run"
        if abs(self.changed - self.predicted) <= LINEAR * abs(self.changed) + self.error:
            return "as predicted"
        return "not linear"


def scaled_point(row, changes):
    """The parameters of a point in the changed run."""
    factors = {one.quantity: one.factor for one in changes if not one.name}
    return [row[name] * factors.get(name, 1.0) for name in PARAMETERS]


def _at(table, point, leave=()):
    names = [name for name in PARAMETERS if name not in leave]
    chosen = np.ones(len(table), bool)
    for name, value in zip(PARAMETERS, point):
        if name in names:
            chosen &= np.isclose(table[name], value, rtol=1e-9, atol=1e-12)
    return table[chosen]


def critical_lines(base, changed, changes):
    """The critical frictions with their changes, [Line]."""
    table, before, after = base.critical_sensitivities, base.critical, changed.critical
    if table is None or before is None:
        return []
    lines, used = [], set()
    for row in before[before["converged"] == 1].to_dict("records"):
        same = (table["friction"] == row["friction"]) & (table["branch"] == row["branch"])
        for name in ("active_set", *PARAMETERS[1:]):
            same &= table[name] == row[name]
        change = predicted(table, same, changes, "friction_derivative")
        place = f"{row['kind']}, {row['frequency_hz']:.6g} Hz"
        line = Line(place, row["friction"], change, np.nan, row["friction_error_estimate"])
        if after is not None and np.isfinite(change):
            found = _at(after, scaled_point(row, changes), leave=("friction",))
            found = found[
                (found["kind"] == row["kind"])
                & (found["converged"] == 1)
                & (found["direction"] == row["direction"])
                & (np.abs(found["frequency_hz"] / row["frequency_hz"] - 1) < FAR)
                & ~found.index.isin(used)
            ]
            if len(found):
                far = np.abs(found["friction"] - row["friction"] - change)
                nearest = found.loc[far.idxmin()]
                used.add(far.idxmin())
                line.changed = nearest["friction"] - row["friction"]
                line.error += nearest["friction_error_estimate"]
        lines.append(line)
    return lines


def mode_lines(base, changed, changes):
    """Frequencies and growth rates of the modes with derivatives, ([Line], [Line])."""
    table, after = base.sensitivities, changed.eigenvalues
    frequencies, growths = [], []
    keys = [*PARAMETERS, "mode"]
    for key, rows in table.groupby(keys, sort=False):
        row = dict(zip(keys, key))
        one = rows.iloc[0]
        selected = table.index.isin(rows.index)
        growth = predicted(table, selected, changes, "growth_rate_derivative_1_per_s")
        frequency = predicted(table, selected, changes, "frequency_derivative_hz")
        s = one["growth_rate_1_per_s"] + 2j * np.pi * one["frequency_hz"]
        point = words_of({name: row[name] for name in base.swept()})
        place = f"{point + ', ' if point else ''}mode {int(row['mode'])}"
        found = _at(after, scaled_point(row, changes))
        change, error = np.nan + 0j, 0.0
        if len(found) and np.isfinite(growth):
            there = s + growth + 2j * np.pi * frequency
            nearest = found.loc[(found["s"] - there).abs().idxmin()]
            if abs(nearest["s"] - there) < FAR * abs(s):
                change = nearest["s"] - s
            before = _at(base.eigenvalues, key[:-1])
            before = before[before["mode"] == row["mode"]].iloc[0]
            error = sum(abs(r["error_estimate"] * r["s"]) for r in (before, nearest))
            error = 0.0 if np.isnan(error) else error
        hertz = change.imag / (2 * np.pi)
        frequencies.append(Line(place, one["frequency_hz"], frequency, hertz, error / (2 * np.pi)))
        growths.append(Line(place, one["growth_rate_1_per_s"], growth, change.real, error))
    return frequencies, growths


def text_of(title, lines, unit):
    """A table as text."""
    if not lines:
        return ""
    head = ["", f"before{unit}", "predicted change", "change", ""]
    body = [
        [
            line.place,
            f"{line.before:.9g}",
            f"{line.predicted:+.4g}",
            f"{line.changed:+.4g}",
            line.verdict(),
        ]
        for line in lines
    ]
    widths = [max(len(row[k]) for row in [head, *body]) for k in range(5)]
    rows = [
        "  ".join(
            cell.ljust(width) if k in (0, 4) else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(row, widths))
        ).rstrip()
        for row in [head, *body]
    ]
    return "\n".join([title, *(f"  {row}" for row in rows)]) + "\n"


def compare(base, changed, changes):
    """The text of the comparison."""
    frequencies, growths = mode_lines(base, changed, changes)
    criticals = critical_lines(base, changed, changes)
    words = ", ".join(change.word for change in changes)
    parts = [
        f"What if {words}: {base.folder} beside {changed.folder}",
        text_of("Critical frictions", criticals, ""),
        text_of("Frequencies", frequencies, " Hz"),
        text_of("Growth rates", growths, " 1/s"),
    ]
    more = int(changed.eigenvalues["grows"].sum()) - int(base.eigenvalues["grows"].sum())
    parts.append(
        "Unstable eigenvalues, summed over all points:"
        f" {int(base.eigenvalues['grows'].sum())} before,"
        f" {int(changed.eigenvalues['grows'].sum())} now"
        + ("; modes that are unstable only after the change have no prediction" if more > 0 else "")
    )
    if any(line.verdict() == "not linear" for line in [*criticals, *frequencies, *growths]):
        parts.append(
            "Not linear: the first derivative misses the change by more than"
            f" {100 * LINEAR:g} % of it; trust the second run, or try a smaller change"
        )
    return "\n".join(part for part in parts if part)


def main(words):
    task, words = words[0], words[1:]
    if task == "check":
        changes_of(words)
    elif task == "options":
        base = Results(words[0])
        for name, value in options_of(base, changes_of(words[1:])):
            print(f"-{name}\n{value}")
    else:
        print(compare(Results(words[0]), Results(words[1]), changes_of(words[2:])))
