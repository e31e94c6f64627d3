# SPDX-License-Identifier: BSD-2-Clause
"""The friction of a case: what is swept, the law over the slip rate, and the band of complex modes.

Interfaces that slide have the coefficient that the case sweeps, times a factor, or a fixed one. If
steps of the deck change the coefficient of some, these are swept and the others are fixed.
"""
import numpy as np

from squeal.deck.journal import TRANSLATED, Fault

STEPS = 10  # of a sweep that replaces the ramp of a step
BAND = 2  # free modes that are computed for each mode asked for


class Frictions:
    """Laws of the interactions of sliding contacts, by key, in the order of the deck."""

    def __init__(self, model, sliding):
        self.model = model
        self.laws = {key: model.interactions[key].frictions for key in sliding}
        changed = [key for key, laws in self.laws.items() if len(laws) > 1]
        self.swept = changed or [key for key, laws in self.laws.items()]
        self.first = next((key for key in self.swept if self.final(key)), None)

    def final(self, key):
        """Returns the last coefficient of an interaction; that at high slip rates if it decays."""
        return coefficient(self.laws[key][-1])

    def ratio(self, key):
        """Returns the coefficient of an interaction over that of the sweep, or None for one that is
        not swept. Raises Fault if steps change the ratio."""
        if key not in self.swept or self.first is None:
            return None
        ratios = [
            coefficient(law[key]) / coefficient(law[self.first])
            for law in self._at_requests()
            if key in law and self.first in law and coefficient(law[self.first])
        ]
        if not ratios:
            return self.final(key) / self.final(self.first)
        if max(ratios) - min(ratios) > 1e-12 * max(ratios):
            raise Fault("the coefficients of two interactions change in different proportions")
        return ratios[-1]

    def _at_requests(self):
        return [request.friction for request in self.model.squeal]

    def values(self):
        """Returns the coefficients at which the deck asks for complex modes, each once, or the
        last one."""
        found = [coefficient(law[self.first]) for law in self._at_requests() if self.first in law]
        return list(dict.fromkeys(found)) or [self.final(self.first)]


def coefficient(law):
    """Returns the constant coefficient of a law, or the one that multiplies its factor: at high
    slip rates of an exponential law, the first one of a table."""
    return law.coefficients[-1] if law.decay is not None else law.coefficients[0]


def set_friction(model, case, journal, frictions, undetermined):
    """Sets the sweep, the law and the band. `frictions`: None if nothing slides with friction;
    `undetermined`: motions of which the deck has only the direction."""
    requests = model.squeal
    if frictions is None:
        _without_sliding(model, case, journal)
    else:
        if frictions.first is None:
            case.set(("flutter", "friction"), 0.0)
        else:
            _set_sweep(frictions, case, journal)
            _set_law(frictions, case, journal)
        damped = any(request.friction_damping for request in requests)
        if any(request.friction_damping != damped for request in requests):
            journal.refuse(requests[-1].source, "some steps have FRICTION DAMPING and some do not")
        if not requests:
            journal.choose("the deck asks for no complex modes; the case has no friction damping")
        source = requests[-1].source if requests else None
        case.set(("flutter", "friction_damping"), damped, source)
        for laws in frictions.laws.values():
            for law in laws:
                journal.mark(law.source, TRANSLATED)
        _set_band(model, case, journal)
    _require_speed(model, case, journal, undetermined)


def _without_sliding(model, case, journal):
    if model.frequency is None:
        journal.choose("the deck asks for no frequencies; the case has one, the least number")
    case.set(("modes", "count"), model.frequencies or 1, model.frequency)
    case.set(("flutter", "friction"), 0.0)
    for request in model.squeal:
        if request.source != model.frequency:
            journal.refuse(
                request.source,
                "complex modes need a contact with friction, one side of which moves (*MOTION, or a"
                " prescribed turn)",
            )


def _require_speed(model, case, journal, undetermined):
    """Names a speed that is needed and that neither deck nor user has given."""
    if not undetermined:
        if model.speed is not None:
            journal.refuse_model("--speed: no motion of the deck is without a speed")
        return
    source = undetermined[0].motion.source
    damping = case.options["flutter"].get("friction_damping", ("off",))[0]
    if model.speed is not None:
        journal.choose(f"{source}: the speed {model.speed:g} of the motion is that of --speed")
    elif "friction" in case.options or damping == "on":
        journal.refuse(
            source,
            "friction damping and friction that depends on the slip rate need the speed of the"
            " motion, which the deck does not have; give it with --speed (per time unit of the"
            " deck: an angle in rad, or a length)",
        )
    else:
        journal.choose(
            f"{source}: the deck has no speed of the motion; it is 1, and only its direction counts"
        )


def _set_sweep(frictions, case, journal):
    values = frictions.values()
    laws = frictions.laws[frictions.first]
    source = laws[-1].source
    begin = coefficient(laws[0])
    path = ("flutter", "friction")
    if len(values) == 1 and len(laws) > 1 and begin != values[0]:
        first, last = sorted((begin, values[0]))
        step = float(f"{(last - first) / STEPS:.12g}")
        case.set(path, f"{first!r}:{last!r}:{step!r}", source)
        journal.choose(
            f"{source}: the ramp of friction from {begin:g} to {values[0]:g} is a sweep in {STEPS}"
            " steps"
        )
    else:
        case.set(path, values if len(values) > 1 else values[0], source)
    others = [key for key in frictions.laws if key not in frictions.swept]
    if others:
        names = ", ".join(f"'{key}'" for key in frictions.swept)
        journal.choose(
            f"the friction of {names} is swept, since a step changes it; the rest is fixed"
        )


def _set_law(frictions, case, journal):
    """The case has one law over the slip rate: the last one of the swept interactions."""
    law = frictions.laws[frictions.first][-1]
    shape = _shape(law)
    for laws in frictions.laws.values():
        for other in laws:
            if coefficient(other) and not np.allclose(_shape(other), shape, 1e-12, 0):
                journal.refuse(
                    other.source, "laws of friction that depend in different ways on the slip rate"
                )
                return
    if law.decay is not None:
        case.set(("friction", "law"), "exponential", law.source)
        case.set(
            ("friction", "static_ratio"), law.coefficients[0] / law.coefficients[1], law.source
        )
        case.set(("friction", "decay_speed"), 1 / law.decay, law.source)
    elif len(law.coefficients) > 1:
        case.set(("friction", "law"), "table", law.source)
        case.set(("friction", "table_speed"), law.speeds, law.source)
        case.set(("friction", "table_factor"), shape[len(law.speeds) :], law.source)


def _shape(law):
    """Returns numbers that two laws with equal factors have in common."""
    if law.decay is not None:
        return np.array([law.coefficients[0] / law.coefficients[1], law.decay])
    factors = np.array(law.coefficients) / law.coefficients[0]
    return np.array([1.0]) if len(factors) == 1 else np.concatenate([law.speeds, factors])


def _set_band(model, case, journal):
    tops = [top for top in (model.top, *(one.top for one in model.squeal)) if top is not None]
    counts = [one.count for one in model.squeal if one.count is not None]
    source = model.frequency or (model.squeal[-1].source if model.squeal else None)
    if tops:
        case.set(("flutter", "band"), max(tops), source)
    count = max([*counts, model.frequencies or 0])
    if count and not tops:
        journal.choose(
            f"the deck asks for {count} modes; the case computes {BAND * count} free modes, since"
            " its band of complex modes ends at about half of them"
        )
        count *= BAND
    if count:
        case.set(("modes", "count"), count, source)
