# SPDX-License-Identifier: BSD-2-Clause
"""The schema of the tables of a run: columns, units and allowed values.

To add a column, add it here and to the writer (src/run/report). tests/python/test_schema.py
compares the two; docs/results.md lists the columns.
"""
import dataclasses
import math
import re

REFEREE_VERDICTS = (
    "right",
    "inexact",
    "double",
    "artefact",
    "missing",
    "unproved",
    "outside",
)
VERDICTS = ("unstable", "undecided", "uncertified", "stable", "neutral")  # the gravest first
CLASSES = ("growing", "steady", "periodic", "modulated", "irregular", "nothing measured")

REACTIONS = (
    "support",
    "ground",
    "spring",
    "bushing",
    "equation",
    "reference",
    "coupling",
    "bolt",
    "tie",
    "interface",
    "tie_offset",
    "interface_offset",
    "periodic",
    "load",
    "sum",
)


@dataclasses.dataclass(frozen=True)
class Column:
    """A column and its allowed values. Tables of all versions must have the columns with `read`,
    which programs here read."""

    name: str  # with {} for a number: velocity_{}_x_m_per_s
    unit: str = ""
    kind: str = "number"  # number, whole, flag (0 or 1), or word
    words: tuple = ()  # of kind word; none: any text
    least: float = -math.inf
    most: float = math.inf
    empty: bool = False  # a cell may be empty: there is nothing to say
    open: bool = False  # nan and inf are allowed: there is no estimate
    read: bool = True

    def matches(self, name):
        return bool(re.fullmatch(re.escape(self.name).replace(r"\{\}", r"[1-9]\d*"), name))


@dataclasses.dataclass(frozen=True)
class Table:
    """The columns of a table. The cells of columns in `together` are all empty or all full."""

    columns: tuple
    together: tuple = ()
    # The last column counts 1, 2, 3, … in the rows that agree in the columns before it.
    counted: tuple = ()

    def column(self, name):
        return next((column for column in self.columns if column.matches(name)), None)


def number(name, unit="", **more):
    return Column(name, unit, **more)


def whole(name, least=0, **more):
    return Column(name, kind="whole", least=least, **more)


def flag(name, **more):
    return Column(name, kind="flag", **more)


def word(name, *words, **more):
    return Column(name, kind="word", words=words, **more)


def numbers(text, **more):
    """Returns columns by their names, which end with their units."""
    return tuple(Column(name, unit_of(name), **more) for name in text.split())


UNITS = {
    "1_per_s": "1/s",
    "rad_per_s": "rad/s",
    "sqrt_kg_m_per_s": "√kg m/s",
    "m2_per_s2": "m²/s²",
    "m_per_s": "m/s",
    "hz": "Hz",
    "n_m": "N m",
    "pa": "Pa",
    "db": "dB re 1e-12 W",
    "m2": "m²",
    "m": "m",
    "n": "N",
    "j": "J",
    "w": "W",
    "s": "s",
}


def unit_of(name):
    return next((unit for end, unit in UNITS.items() if name.endswith("_" + end)), "")


POINT = numbers("friction speed pressure damping")
MODE = (whole("mode", 1), *numbers("growth_rate_1_per_s"))
PLACE = numbers("x_m y_m z_m")
RUN = (*POINT, word("start"))
SIZE = {"least": 0}

TABLES = {
    "eigenvalues": Table(
        (
            *POINT,
            *MODE,
            *numbers("angular_frequency_rad_per_s"),
            *numbers("frequency_hz", read=False),
            number("damping_ratio", least=-1, most=1, empty=True, open=True, read=False),
            number("backward_error", least=0, open=True, read=False),
            number("error_estimate", least=0, open=True, read=False),
            *numbers("radius_1_per_s", empty=True, read=False, **SIZE),
            flag("certified", read=False),
            word("verdict", *VERDICTS),
            flag("unstable"),
            word("name", empty=True, read=False),
        ),
        counted=("friction", "speed", "pressure", "damping", "mode"),
    ),
    "stability_map": Table(
        (
            *POINT,
            whole("unstable_modes", empty=True),
            *numbers("largest_growth_rate_1_per_s", empty=True),
            *numbers("frequency_hz", empty=True, read=False),
            *numbers("worst_backward_error worst_error_estimate", empty=True, read=False, **SIZE),
            word("verdict", *VERDICTS, empty=True),
            whole("undecided_modes", empty=True, read=False),
        ),
        together=(
            ("unstable_modes", "verdict", "undecided_modes"),
            ("largest_growth_rate_1_per_s", "frequency_hz"),
        ),
    ),
    "proof": Table(
        (
            *POINT,
            flag("complete", read=False),
            flag("count_proved", read=False),
            number("eigenvalues", read=False),
            *numbers("top_hz", open=True, read=False),
            *numbers("left_1_per_s", empty=True, read=False),
            *numbers("ratio definiteness", open=True, read=False),
            *(whole(name, read=False) for name in ("discs", "without_disc", "missing")),
            *(whole(name, read=False) for name in ("spurious", "undecided")),
            word("reason", empty=True, read=False),
        ),
    ),
    "branches": Table(
        (
            whole("active_set"),
            whole("branch", 1),
            *POINT,
            *numbers("growth_rate_1_per_s frequency_hz"),
            *numbers("angular_frequency_rad_per_s", read=False),
            number("overlap", open=True, read=False),
            flag("in_band"),
            flag("swept", read=False),
        )
    ),
    "critical": Table(
        (
            whole("active_set"),
            *(whole(name, read=False) for name in ("branch", "partner")),
            word("kind", "coalescence", "hopf", "divergence", "contact"),
            word("direction", "loss", "regain"),
            *POINT,
            *numbers("frequency_hz"),
            number("slope", open=True, read=False),
            number("friction_error_estimate", least=0, open=True, read=False),
            number("backward_error", least=0, open=True, read=False),
            flag("converged", read=False),
            whole("free_mode", 1, empty=True, read=False),
            number("energy_share", least=0, empty=True, read=False),
            whole("second_free_mode", 1, empty=True, read=False),
            number("second_energy_share", least=0, empty=True, read=False),
            word("name", empty=True, read=False),
        ),
        together=(("free_mode", "energy_share"), ("second_free_mode", "second_energy_share")),
    ),
    "critical_sensitivities": Table(
        (
            whole("active_set"),
            *(whole(name, read=False) for name in ("branch", "partner")),
            word("kind", "coalescence", "hopf", "divergence", "contact"),
            word("direction", "loss", "regain"),
            *POINT,
            *numbers("frequency_hz"),
            number("right_backward_error", least=0, empty=True, read=False),
            number("left_backward_error", least=0, empty=True, read=False),
            word("parameter"),
            number("friction_derivative", empty=True),
        ),
        together=(("right_backward_error", "left_backward_error"),),
    ),
    "contact_path": Table(
        (*POINT[:3], *PLACE, word("interface"), word("change", "opens", "closes", "unheld", "held"))
    ),
    "friction_work": Table(
        (
            *POINT,
            *MODE,
            *numbers("frequency_hz"),
            word("interface"),
            number("friction_work_1_per_s", "1/s"),
        )
    ),
    "components": Table(
        (
            *POINT,
            *MODE,
            *numbers("frequency_hz"),
            word("kind"),
            word("component"),
            *numbers("strain_share kinetic_share", open=True),
            word("motion", empty=True),
            number("motion_share", least=0, empty=True),
            *numbers(
                "damping_1_per_s follower_1_per_s friction_damping_1_per_s law_slope_1_per_s"
                " convective_1_per_s gyroscopic_1_per_s"
            ),
        )
    ),
    "mode_components": Table(
        (
            whole("active_set", 1),
            whole("mode", 1),
            *numbers("frequency_hz", **SIZE),
            word("kind"),
            word("component"),
            *numbers("strain_share kinetic_share", open=True),
            word("motion", empty=True),
            number("motion_share", least=0, empty=True),
        )
    ),
    "component_modes": Table(
        (
            word("body"),
            whole("mode", 1),
            *numbers("frequency_hz", **SIZE),
            word("motion", empty=True),
            number("motion_share", least=0, empty=True),
        )
    ),
    "participation": Table(
        (
            *POINT,
            *MODE,
            *numbers("frequency_hz"),
            whole("free_mode"),
            *numbers("free_frequency_hz", empty=True, **SIZE),
            *numbers("energy_share mac", open=True),
            *numbers("amplitude phase_deg", empty=True),
        ),
        together=(("free_frequency_hz", "amplitude", "phase_deg"),),
    ),
    "participation_bodies": Table(
        (
            *POINT,
            *MODE,
            *numbers("frequency_hz"),
            whole("free_mode", 1),
            *numbers("free_frequency_hz", **SIZE),
            word("body"),
            number("mac", least=0),
        )
    ),
    "sensitivities": Table(
        (
            *POINT,
            *MODE,
            *numbers("frequency_hz"),
            *(
                number(name, least=0, open=True, read=False)
                for name in ("condition", "separation", "left_backward_error")
            ),
            word("parameter"),
            *numbers("growth_rate_derivative_1_per_s frequency_derivative_hz", empty=True),
            number("growth_holds_to", least=0, empty=True, read=False),
        ),
        together=(("growth_rate_derivative_1_per_s", "frequency_derivative_hz"),),
    ),
    "modes": Table(
        (
            whole("mode", 1),
            *numbers("angular_frequency_rad_per_s frequency_hz", **SIZE),
            number("relative_residual", least=0, open=True, read=False),
            word("name", empty=True, read=False),
        ),
        counted=("mode",),
    ),
    "steady": Table(
        (
            *PLACE,
            *numbers(
                "gap_m normal_force_n pressure_pa friction_force_x_n friction_force_y_n"
                " friction_force_z_n"
            ),
            word("interface"),
            word(
                "state",
                "open",
                "sliding",
                "frictionless",
                "sticking",
                "released",
                "unheld",
                "beyond_friction",
            ),
        )
    ),
    "reactions": Table(
        (
            *POINT[:3],
            word("kind", *REACTIONS),
            word("name", empty=True, read=False),
            *numbers("force_x_n force_y_n force_z_n moment_x_n_m moment_y_n_m moment_z_n_m"),
        )
    ),
    "onset": Table(
        (
            *POINT,
            *MODE,
            *numbers("frequency_hz"),
            word("event", "none", "opens", "comes_to_rest", "slides"),
            *numbers("x_m y_m z_m", empty=True),
            word("interface", empty=True),
            *numbers("kinetic_energy_j turning", empty=True),
        ),
        together=(("x_m", "y_m", "z_m", "interface", "kinetic_energy_j", "turning"),),
    ),
    "regime": Table(
        (
            *RUN,
            word("class", *CLASSES),
            flag("settled"),
            *numbers("duration_s", empty=True, read=False, **SIZE),
            *numbers("step_s", read=False, **SIZE),
            *numbers("carrier_hz", empty=True),
            *numbers("flutter_frequency_hz"),
            *numbers("modulation_hz growth_rate_1_per_s", empty=True, read=False),
            *numbers("certified_growth_rate_1_per_s", read=False),
            *numbers(
                (
                    "largest_kinetic_energy_j mean_kinetic_energy_j peak_deviation"
                    " largest_slip_velocity_m_per_s largest_gap_change_m"
                ),
                empty=True,
                read=False,
                **SIZE,
            ),
            *numbers(
                "friction_coefficient friction_power_w steady_friction_power_w",
                empty=True,
                read=False,
            ),
            *numbers("open_nodes sticking_nodes", empty=True, read=False, **SIZE),
            whole("contact_nodes", empty=True, read=False),
            *numbers("onset_kinetic_energy_j", empty=True, **SIZE),
            *numbers(
                (
                    "largest_defect energy_imbalance model_error mean_square_velocity_m2_per_s2"
                    " radiating_area_m2 sound_power_estimate_w sound_power_level_db"
                ),
                empty=True,
                read=False,
            ),
        ),
        together=(("open_nodes", "sticking_nodes", "mean_kinetic_energy_j"),),
    ),
    "regime_nodes": Table(
        (
            *RUN,
            *PLACE,
            word("interface"),
            *(number(name, least=0, most=1) for name in ("open", "stick", "slip")),
            *numbers("mean_pressure_pa largest_gap_m friction_power_w", read=False),
        )
    ),
    "regime_cycles": Table(
        (*RUN, whole("cycle", 1), *numbers("time_s largest_kinetic_energy_j", **SIZE)),
        counted=("friction", "speed", "pressure", "damping", "start", "cycle"),
    ),
    "regime_spectrum": Table(
        (
            *RUN,
            *numbers("frequency_hz velocity_sqrt_kg_m_per_s", **SIZE),
            *numbers(
                (
                    "velocity_{}_x_m_per_s velocity_{}_y_m_per_s velocity_{}_z_m_per_s"
                    " velocity_{}_normal_m_per_s"
                ),
                read=False,
                **SIZE,
            ),
        )
    ),
    "regime_points": Table(
        (
            *RUN,
            whole("point", 1),
            word("name"),
            *PLACE,
            *numbers("normal_x normal_y normal_z", least=-1, most=1),
            *numbers("mean_square_velocity_m2_per_s2", empty=True, **SIZE),
        )
    ),
    "periodic": Table(
        (
            *RUN,
            whole("motion", 1),
            number("motion_friction"),
            flag("converged"),
            number("frequency_hz", "Hz", least=0, open=True),
            number("change", open=True, read=False),
            *numbers("largest_kinetic_energy_j", open=True),
            *numbers("friction_coefficient friction_power_w", open=True, read=False),
            *(whole(name, read=False) for name in ("opening_nodes", "sticking_nodes")),
            *numbers("trivial_multiplier", empty=True, read=False, **SIZE),
            *numbers("largest_multiplier", empty=True, **SIZE),
            flag("stable", empty=True),
        ),
        together=(("trivial_multiplier", "largest_multiplier", "stable"),),
    ),
    "periodic_branch": Table(
        (
            *RUN,
            word("towards", "smaller", "larger", read=False),
            *numbers("fold_friction", empty=True),
            *numbers("end_friction", empty=True, read=False),
            word("reason", read=False),
        )
    ),
    "referee": Table(
        (
            whole("entry", 1, empty=True),
            *numbers("growth_rate_1_per_s angular_frequency_rad_per_s", empty=True),
            word("verdict", *REFEREE_VERDICTS),
            *numbers("proved_growth_rate_1_per_s proved_angular_frequency_rad_per_s", empty=True),
            *numbers("radius_rad_per_s distance_rad_per_s", empty=True, **SIZE),
        ),
        together=(
            ("growth_rate_1_per_s", "angular_frequency_rad_per_s"),
            (
                "proved_growth_rate_1_per_s",
                "proved_angular_frequency_rad_per_s",
                "radius_rad_per_s",
            ),
        ),
    ),
    "floquet": Table(
        (
            *RUN,
            whole("motion", 1),
            *numbers("motion_friction real imaginary"),
            *numbers("modulus", **SIZE),
            *numbers("frequency_hz growth_rate_1_per_s", open=True),
            flag("trivial"),
        )
    ),
}


def schema_of(name):
    """Returns the schema of a table by its name without ending, modes_POINT as modes; None for
    tables that no run writes."""
    if name in TABLES:
        return TABLES[name]
    return TABLES.get(
        next((kind for kind in ("modes", "steady") if name.startswith(f"{kind}_")), None)
    )


__all__ = ["CLASSES", "TABLES", "VERDICTS", "Column", "Table", "schema_of"]
