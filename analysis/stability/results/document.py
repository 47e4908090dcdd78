"""Study as a document for other programs: dB, deg and s, complex numbers as [real, imaginary]."""

from __future__ import annotations

import math
from dataclasses import asdict

import numpy as np

from ..loops.margin_values import UNLIMITED, UNSTABLE, LoopMargins, MarginQuantity
from ..loops.readings import decibels, degree_size
from .report import JointReport, LoopReport, PointReport, StabilityStudy
from .requirement import MarginRequirement, MarginVerdict
from .responses import Nonlinearity
from .varied import Dispersion, SweepReport

KEYS = {
    "gain_margin_db": MarginQuantity.GAIN,
    "phase_margin_deg": MarginQuantity.PHASE,
    "modulus_margin": MarginQuantity.MODULUS,
    "disk_margin": MarginQuantity.DISK,
}


def document(report: StabilityStudy) -> dict[str, object]:
    """Return the whole report as strict JSON, without the linearisation's curves.

    No number is infinite: a margin is a number, "unstable", "unlimited", or null if it is unknown.
    """
    content: dict[str, object] = {
        "system": report.system,
        "verdict": report.verdict,
        "limits": report.limits,
        "points": [_point(point) for point in report.points],
        "loops": [_loop(loop) for loop in report.loops],
        "joint": [_joint(joint) for joint in report.joint],
        "sweeps": [_sweep(sweep) for sweep in report.sweeps],
        "unstudied": [asdict(item) for item in report.unstudied],
        "provenance": report.provenance,
    }
    if (orders := report.orders) is not None:
        content["feedthrough_orders"] = {
            "undeclared": orders.undeclared,
            "direct": list(orders.direct),
            "without": list(orders.without),
            "cuts": list(orders.cuts),
            "as_feedthrough": None if orders.report is None else document(orders.report),
        }
    return {name: _finite(item) for name, item in content.items()}


def _finite(value: object) -> object:
    """Return the same content with null for every number that is NaN or infinite."""
    if isinstance(value, dict):
        return {name: _finite(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _size(value: float | None, *, stable: bool = True) -> float | str | None:
    """Return the size of a margin: a number, a word, or None if it is unknown."""
    if not stable:
        return "unstable"
    if value is None or math.isnan(value):
        return None
    return {UNSTABLE: "unstable", UNLIMITED: "unlimited"}.get(value, float(value))


def loop_margins(loop: LoopReport) -> dict[str, float | str | None]:
    """Return the four margins and the delay margin of a loop, by key."""
    delay = _size(loop.classical.delay_margin, stable=not loop.margins.unstable)
    return {**_margins(loop.margins), "delay_margin_s": delay}


def joint_margin(joint: JointReport) -> float | str | None:
    """Return the simultaneous disk margin of a loop's channels."""
    return _size(joint.disk_margin, stable=joint.stable)


def _margins(margins: LoopMargins | None) -> dict[str, float | str | None]:
    """Return the four margins, or None if they are unknown."""
    return {name: _size(None if margins is None else margins.size(quantity)) for name, quantity in KEYS.items()}


def _complex(values: np.ndarray) -> list[list[float]]:
    return [[float(value.real), float(value.imag)] for value in values]


def _loop(loop: LoopReport) -> dict[str, object]:
    stable = not loop.margins.unstable
    entry: dict[str, object] = {
        "name": loop.name,
        "loop": loop.loop,
        "point": loop.point,
        "cut": loop.cut,
        "returned": loop.returned,
        "unit": loop.unit,
        "sample_period_s": loop.sample_period,
        "closed": list(loop.closed),
        "verdict": loop.verdict,
        "stable": loop.stable,
        "outside": list(loop.outside),
        **loop_margins(loop),
        "disk_gain_db": _size(decibels(loop.robust.disk_gain), stable=stable),
        "disk_phase_deg": _size(degree_size(loop.robust.disk_phase), stable=stable),
        "sensitivity_peak": loop.robust.sensitivity_peak,
        "complementary_peak": loop.robust.complementary_peak,
        "gain_crossings": [
            {"gain_db": decibels(item.value), "frequency_rad_s": item.frequency} for item in loop.classical.gain
        ],
        "phase_crossings": [
            {"phase_deg": math.degrees(item.value), "frequency_rad_s": item.frequency} for item in loop.classical.phase
        ],
        "encirclements": loop.classical.encirclements,
        "unstable_open": loop.unstable_open,
        "poles_z": _complex(loop.poles_z),
        "modes": [
            {
                "z": [mode.z.real, mode.z.imag],
                "damping": mode.damping,
                "frequency_rad_s": mode.frequency,
                "kind": mode.kind,
            }
            for mode in loop.modes
        ],
        "requirements": [_requirement(item) for item in loop.requirements],
        "not_applicable": loop.not_applicable,
        "nonlinearities": [_element(item) for item in loop.nonlinearities],
        "sampling": [{"step_s": item.step, **_margins(item.margins), "note": item.note} for item in loop.sampling],
        "amplitudes": [
            {"amplitude": item.amplitude, "L": [item.value.real, item.value.imag], "change": item.change}
            for item in loop.amplitudes
        ],
    }
    if (facts := loop.linearised) is not None:
        entry["linearised"] = {
            "states": facts.states,
            "period_s": facts.period,
            "plateau": facts.plateau,
            "doubtful": list(facts.doubtful),
            "periodicity": facts.periodicity,
        }
    if (measured := loop.measured_response) is not None:
        entry["measured_response"] = {
            "amplitude": measured.amplitude,
            "lines": measured.lines,
            "period_s": measured.period,
            "half_amplitude_change": measured.half_amplitude_change,
            "unexcited": measured.unexcited,
            "frequency_rad_s": [float(value) for value in measured.curve.frequency],
            "L": _complex(measured.curve.value),
        }
    if loop.agreement is not None:
        entry["agreement"] = {
            "gain_db": decibels(loop.agreement.gain),
            "phase_deg": math.degrees(loop.agreement.phase),
            "agrees": loop.agreement.agrees,
        }
    if loop.dispersion is not None:
        entry["dispersion"] = _dispersion(loop.dispersion)
    return entry


def _requirement(item: MarginRequirement) -> dict[str, object]:
    return {
        "scope": item.scope,
        "quantity": item.quantity,
        "value": _size(item.value),
        "limit": item.limit,
        "unit": item.unit,
        "passed": {MarginVerdict.PASS: True, MarginVerdict.FAIL: False}.get(item.verdict),
        "verdict": item.verdict,
        "note": item.note,
        **({"as_feedthrough": _requirement(item.as_feedthrough)} if item.as_feedthrough is not None else {}),
    }


def _element(item: Nonlinearity) -> dict[str, object]:
    return {
        "name": item.name,
        "kind": item.kind,
        "parameters": item.parameters,
        "limit_cycles": [
            {
                "amplitude": cycle.amplitude,
                "period_s": cycle.period,
                "stable": cycle.stable,
                "simulated_amplitude": cycle.simulated_amplitude,
                "simulated_period_s": cycle.simulated_period,
            }
            for cycle in item.cycles
        ],
        "note": item.note,
    }


def _dispersion(item: Dispersion) -> dict[str, object]:
    levels = {
        name: {level: _size(value) for level, value in item.levels(quantity).items()} for name, quantity in KEYS.items()
    }
    return {
        "campaign": item.campaign,
        "trials": item.trials,
        "unstable_trials": item.unstable,
        **levels,
        "worst_trial": item.worst,
        "replay": item.replay,
        "requirements": [_requirement(entry) for entry in item.requirements],
    }


def _joint(joint: JointReport) -> dict[str, object]:
    return {
        "name": joint.name,
        "point": joint.point,
        "channels": list(joint.channels),
        "stable": joint.stable,
        "verdict": joint.verdict,
        "disk_margin": joint_margin(joint),
        "disk_gain_db": _size(decibels(joint.disk_gain), stable=joint.stable),
        "disk_phase_deg": _size(degree_size(joint.disk_phase), stable=joint.stable),
        "frequency_rad_s": joint.disk_frequency,
        "requirements": [_requirement(item) for item in joint.requirements],
    }


def _sweep(sweep: SweepReport) -> dict[str, object]:
    return {
        "name": sweep.name,
        "loop": sweep.loop,
        "parameter": sweep.parameter,
        "values": [float(value) for value in sweep.values],
        **{name: [_size(item.size(quantity)) for item in sweep.margins] for name, quantity in KEYS.items()},
        "crossings": [
            {"quantity": item.quantity, "value": item.value, "fails": "below" if item.below else "above"}
            for item in sweep.crossings
        ],
    }


def _point(point: PointReport) -> dict[str, object]:
    return {
        "name": point.name,
        "phase": point.phase,
        "time_s": point.time,
        "settings": {name: str(value) for name, value in point.settings.items()},
        "drift": point.drift,
        "holds_s": point.holds,
    }
