# SPDX-License-Identifier: BSD-2-Clause
"""The results of a run: tables, modes and fields."""
import contextlib
import dataclasses
import functools
import os
from pathlib import Path

import h5py
import numpy as np
import pandas as pd

from squeal import schema
from squeal.agreement import require_agreement
from squeal.files import ResultsError, is_there, open_regular
from squeal.keys import PARAMETERS, words_of
from squeal.summary import read_summary
from squeal.tables import read_table

# A growth rate below this fraction of |s| is round-off, if there is no estimate of its error.
NOISE = 1e-6


def open(folder):
    """Returns the results in a folder. Raises ResultsError if they are missing, incomplete or
    damaged."""
    return Results(folder)


class Results:
    """The results of one run. The constructor reads and checks its tables; results.h5 is opened
    at the first use."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.summary = read_summary(self.folder / "summary.json")
        shapes = self.summary.get("tables", {})
        # Tables by name: cells as texts, and as numbers.
        self.texts, self._tables = (
            {},
            {},
        )
        for name in sorted({*shapes, *self._found()}):
            self.texts[name], self._tables[name] = read_table(
                self.folder / f"{name}.csv", shapes.get(name)
            )
        require_agreement(self.folder, self.summary, self._tables)

    def _found(self):
        """Returns the names of the tables that a run may have written; other files are the
        user's."""
        try:
            paths = sorted(self.folder.glob("*.csv"))
            return [
                path.stem
                for path in paths
                if schema.schema_of(path.stem)
                and (path.stem in schema.TABLES or self._lists(path))
                and is_there(path)
            ]
        except OSError as error:
            raise ResultsError(f"{self.folder}: {error.strerror}") from None

    def _lists(self, path):
        """Returns whether this run wrote a table of one point; a file such as steady_notes.csv
        is the user's."""
        return path.stem in self.summary.get("tables", {}) or any(
            path.stem.endswith(f"_{point['friction']:g}")
            for point in self.summary.get("frictions", [])
        )

    def __repr__(self):
        return f"<squeal results in {self.folder}: {len(self.points)} points>"

    def table(self, name):
        """Returns a .csv file of the folder by its name without ending; None if the run wrote
        none."""
        table = self._tables.get(name)
        return None if table is None else table.copy()

    @functools.cached_property
    def eigenvalues(self):
        """All eigenvalues of the band, with two more columns: `s`, the complex eigenvalue in
        1/s, and `grows`, which is true if the program counts the mode as unstable."""
        table = self._needed("eigenvalues")
        s = table["growth_rate_1_per_s"] + 1j * table["angular_frequency_rad_per_s"]
        return table.assign(s=s, grows=table["unstable"] == 1)

    @functools.cached_property
    def stability_map(self):
        """A row for each point of the sweep."""
        return self._needed("stability_map")

    @property
    def points(self):
        """The parameters of the points of the sweep."""
        return self.stability_map[list(PARAMETERS)]

    def swept(self):
        """The names of the parameters with several values."""
        return [name for name in PARAMETERS if self.points[name].nunique() > 1]

    @functools.cached_property
    def branches(self):
        """The eigenvalues followed over the friction; None if the run did not follow them."""
        return self.table("branches")

    @functools.cached_property
    def critical(self):
        """The frictions at which stability changes; None if the run did not follow eigenvalues."""
        return self.table("critical")

    @functools.cached_property
    def contact_path(self):
        """The places where contact nodes separate and close between the points; None if not
        computed."""
        return self.table("contact_path")

    @functools.cached_property
    def reactions(self):
        """The forces and moments that hold and join the bodies at each point; None for matrices
        from files."""
        return self.table("reactions")

    @functools.cached_property
    def friction_work(self):
        """The growth that the friction of each interface adds to the stored modes; None for
        matrices from files."""
        return self.table("friction_work")

    @functools.cached_property
    def components(self):
        """Shares of the components in the stored complex modes; None for matrices from files."""
        return self.table("components")

    @functools.cached_property
    def participation(self):
        """The free modes that the stored complex modes are made of."""
        return self.table("participation")

    @functools.cached_property
    def participation_bodies(self):
        """MAC of the stored complex modes with their main free modes, body by body; None for
        matrices from files."""
        return self.table("participation_bodies")

    @functools.cached_property
    def component_modes(self):
        """Elastic modes of each body by itself; None without -report_component_modes."""
        return self.table("component_modes")

    @functools.cached_property
    def sensitivities(self):
        """Derivatives of eigenvalues; None without -flutter_sensitivities."""
        return self.table("sensitivities")

    @functools.cached_property
    def critical_sensitivities(self):
        """Derivatives of critical frictions; None without -flutter_sensitivities and tracking."""
        return self.table("critical_sensitivities")

    @functools.cached_property
    def free_modes(self):
        """Free modes of the first active set; None without them, as with the direct method."""
        return self.table("modes")

    def steady(self, **at):
        """Returns gap, pressure, forces and state of each contact node at a point; None without
        steady sliding."""
        return self.table("steady_" + self._point(at))

    @property
    def parts(self):
        """The folders of the merged runs (scripts/squeal-merge), which hold the shapes of modes;
        empty for a run."""
        return [self.folder / part["folder"] for part in self.summary.get("parts", [])]

    def kept_modes(self):
        """Returns the complex modes whose shapes were stored: parameters, number at the point,
        s, verdict."""
        rows = []
        with contextlib.nullcontext({}) if self.parts else self._fields() as file:
            for group in file.get("flutter", {}).values():
                numbers = sorted(
                    int(name.split("_")[1]) for name in group if name.endswith("_real")
                )
                rows += [
                    {**{name: group.attrs[name] for name in PARAMETERS}, "mode": number}
                    for number in numbers
                ]
        kept = pd.DataFrame(rows, columns=[*PARAMETERS, "mode"])
        return kept.merge(self.eigenvalues, on=[*PARAMETERS, "mode"], how="left")

    def mode(self, number, **at):
        """Returns a complex mode whose shape was stored, by its number at a point. Raises
        ResultsError if there is none."""
        with self._fields() as file:
            group = self._group(file, "flutter", at)
            name = f"mode_{number:03d}"
            if group is None or f"{name}_real" not in group:
                raise ResultsError(
                    f"{self.folder / 'results.h5'}: no shape of mode {number} was kept at"
                    f" {words_of(at) or 'this point'}"
                )
            growth, angular = group["eigenvalues"][number - 1, :2]
            shape = group[f"{name}_real"][()] + 1j * group[f"{name}_imaginary"][()]
            work = group[f"{name}_friction_work"][()] if f"{name}_friction_work" in group else None
            values = {name: float(group.attrs[name]) for name in PARAMETERS}
        return Mode(self, values, number, complex(growth, angular), shape, work)

    def shapes(self, **at):
        """Returns the stored shapes of the complex modes of a point, by number."""
        with self._fields() as file:
            group = self._group(file, "flutter", at) or {}
            numbers = sorted(int(name.split("_")[1]) for name in group if name.endswith("_real"))
            return {
                number: group[f"mode_{number:03d}_real"][()]
                + 1j * group[f"mode_{number:03d}_imaginary"][()]
                for number in numbers
            }

    def free_shapes(self):
        """Returns the stored shapes of the free modes of the first active set, by number."""
        with self._fields() as file:
            group = file["modes/active_set_1"] if "modes/active_set_1" in file else {}
            return {
                int(name.split("_")[1]): group[name][()]
                for name in sorted(group)
                if name.startswith("mode_")
            }

    def has_shapes(self):
        """Returns whether the folder holds shapes of modes: not a merge, nor a run with
        -report_fields off."""
        return not self.parts and self.summary.get("options", {}).get("report_fields") != "off"

    def mac(self, other, kind="complex", **at):
        """Returns the MAC of the stored complex modes of a point, or with kind="free" of the free
        modes, with those of another run on the same mesh: a row for each mode, a column for each
        mode of the other run."""
        from squeal.pairs import mac_table

        return mac_table(self, other, kind, at)

    def compare(self, other):
        """Returns the free modes and the complex modes at all common points with their partners in
        another run and the changes of frequency and growth. A mode without partner has empty
        cells."""
        from squeal.pairs import compare

        return compare(self, other)

    def fastest_mode(self, **at):
        """Returns the fastest growing mode whose shape was stored, of the points with these
        values of parameters; None if there is none."""
        kept = _rows(self.kept_modes(), at)
        if kept.empty:
            return None
        row = kept.loc[kept["growth_rate_1_per_s"].idxmax()]
        return self.mode(int(row["mode"]), **{name: row[name] for name in PARAMETERS})

    def fields(self, **at):
        """Returns the fields of steady sliding at a point by name, node by node: `displacement`
        in m, `contact_pressure_gap`."""
        with self._fields() as file:
            group = self._group(file, "steady", at)
            if group is None:
                raise ResultsError(
                    f"{self.folder / 'results.h5'}: there is no steady sliding at"
                    f" {words_of(at) or 'this point'}"
                )
            return {name: data[()] for name, data in group.items()}

    @functools.cached_property
    def mesh(self):
        """Coordinates in m, cells by gmsh's element type, and names of the bodies; None for
        matrices from files."""
        with self._fields() as file:
            if "mesh" not in file:
                return None
            group = file["mesh"]
            names = group.attrs["bodies"]
            cells = {
                int(name.split("_")[1]): {key: data[()] for key, data in block.items()}
                for name, block in group.items()
                if name.startswith("cells_")
            }
            return Mesh(
                group["coordinates"][()],
                cells,
                (names.decode() if isinstance(names, bytes) else str(names)).split(","),
                group["node_tag"][:, 0],
            )

    def grid(self):
        """The mesh as a vtkUnstructuredGrid, with the number of the body of each cell."""
        from squeal.grid import grid_of  # VTK takes a second to load

        if self.mesh is None:
            raise ResultsError(f"{self.folder}: results of matrices have no mesh")
        return grid_of(self.mesh)

    def _needed(self, name):
        table = self.table(name)
        if table is None:
            raise ResultsError(f"{self.folder / name}.csv is missing")
        return table

    @contextlib.contextmanager
    def _fields(self):
        """Opens results.h5. Damage in it shows where it is read."""
        if self.parts:
            raise ResultsError(
                f"{self.folder} is a merge: modes and fields are in its parts,"
                f" {', '.join(map(str, self.parts))}"
            )
        path = self.folder / "results.h5"
        try:
            with os_closing(open_regular(path)), h5py.File(path) as file:
                yield file
        except ResultsError:
            raise
        except FileNotFoundError:
            raise ResultsError(
                f"{path} is missing: fields were not written (-report_fields off), or it has been"
                " removed"
            ) from None
        except (
            OSError,
            KeyError,
            IndexError,
            ValueError,
            TypeError,
            AttributeError,
            RuntimeError,
        ) as error:
            raise ResultsError(f"{path} is damaged: {' '.join(str(error).split())}") from None

    def _point(self, at):
        """Returns the name of a point in names of files, by the rule of the program: friction,
        and other parameters that are not 1."""
        values = self.only_point(at)
        return f"{values['friction']:g}" + "".join(
            f"_{name}_{values[name]:g}" for name in PARAMETERS[1:] if values[name] != 1
        )

    def only_point(self, at):
        """Returns the parameters of the only point with some values. Raises ResultsError if there
        is none, or more than one."""
        found = _rows(self.points, at)
        if len(found) != 1:
            raise ResultsError(
                f"{self.folder}: {len(found)} points of the sweep have"
                f" {words_of(at) or 'no given parameters'}; name one"
            )
        return found.iloc[0]

    def _group(self, file, kind, at):
        values = self.only_point(at)
        for group in file.get(kind, {}).values():
            if all(
                np.isclose(group.attrs[name], values[name], rtol=1e-12, atol=0)
                for name in PARAMETERS
            ):
                return group
        return None


@dataclasses.dataclass
class Mesh:
    """The mesh of a run."""

    coordinates: np.ndarray  # m, [node, 3]
    # By gmsh's element type: `nodes` [cell, node of the cell], `body` and `tag` [cell, 1].
    cells: dict
    bodies: list  # their names
    tags: np.ndarray = None  # of the nodes in the mesh file


@dataclasses.dataclass
class Mode:
    """A complex mode: the motion is Re(shape exp(s t))."""

    results: Results
    at: dict  # parameters of its point
    number: int  # in the list of the point, from 1
    s: complex  # 1/s
    shape: np.ndarray  # [node, components]; rows of the matrices for a run without mesh
    friction_work: np.ndarray  # work of friction in a cycle, [node, 3]; None without contact

    @property
    def frequency(self):
        """Hz"""
        return self.s.imag / (2 * np.pi)

    @property
    def growth(self):
        """1/s"""
        return self.s.real

    def displacement(self, phase=0.0):
        """Re(shape exp(i phase)), of largest amplitude 1, [node, 3]."""
        amplitude = np.sqrt((np.abs(self.shape) ** 2).sum(axis=1)).max()
        moved = (self.shape * np.exp(1j * phase)).real / amplitude
        return np.pad(moved, ((0, 0), (0, 3 - moved.shape[1])))

    def grid(self, phase=0.0):
        """The mesh as a vtkUnstructuredGrid with the arrays `displacement`, as displacement() gives
        it, and `amplitude`."""
        from squeal.grid import add_points

        grid = self.results.grid()
        add_points(grid, "displacement", self.displacement(phase))
        amplitude = np.sqrt((np.abs(self.shape) ** 2).sum(axis=1))
        add_points(grid, "amplitude", amplitude / amplitude.max())
        return grid


@contextlib.contextmanager
def os_closing(file):
    """Keeps a regular file open while a library opens it by its name."""
    try:
        yield
    finally:
        os.close(file)


def _rows(table, at):
    unknown = [name for name in at if name not in PARAMETERS]
    if unknown:
        raise ResultsError(
            f"{', '.join(unknown)} is not a parameter of a sweep: {', '.join(PARAMETERS)}"
        )
    chosen = np.ones(len(table), bool)
    for name, value in at.items():
        chosen &= np.isclose(table[name], value, rtol=1e-12, atol=1e-300)
    return table[chosen]
