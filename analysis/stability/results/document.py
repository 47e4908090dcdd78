"""A study as a document for other programs: dB, deg and s, complex numbers as [real, imaginary]."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

import numpy as np

from ..loops.margin_values import UNLIMITED, UNSTABLE, Margins, Quantity
from ..loops.readings import decibels, degree_size
from .report import JointReport, LoopReport, PointReport, StabilityReport
from .requirement import Requirement, Verdict
from .responses import Nonlinearity
from .varied import Dispersion, SweepReport

KEYS = {
    "gain_margin_db": Quantity.GAIN,
    "phase_margin_deg": Quantity.PHASE,
    "modulus_margin": Quantity.MODULUS,
    "disk_margin": Quantity.DISK,
}


def document(report: StabilityReport) -> dict[str, Any]:
    """The whole report without the linearisation's curves, ready for strict JSON.

    No number is infinite: a margin is a number, "unstable", "unlimited", or null where it is not known.
    """
    content: dict[str, Any] = {
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
    return _finite(content)


def _finite(value: Any) -> Any:
    """The same with null for every number that is none or infinite."""
    if isinstance(value, dict):
        return {name: _finite(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _size(value: float | None) -> float | str | None:
    """The size of a margin: a number, or what it is instead of one."""
    if value is None:
        return None
    return {UNSTABLE: "unstable", UNLIMITED: "unlimited"}.get(value, float(value))


def _margins(margins: Margins | None) -> dict[str, Any]:
    """The four margins; null where there are none to be had."""
    return {name: _size(None if margins is None else margins.size(quantity)) for name, quantity in KEYS.items()}


def _complex(values: np.ndarray) -> list[list[float]]:
    return [[float(value.real), float(value.imag)] for value in values]


def _loop(loop: LoopReport) -> dict[str, Any]:
    margins = loop.margins

    def json_holds(value: float) -> float | str | None:
        return _size(UNSTABLE if margins.unstable else value)

    entry: dict[str, Any] = {
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
        **_margins(margins),
        "delay_margin_s": json_holds(loop.classical.delay_margin),
        "disk_gain_db": json_holds(decibels(loop.robust.disk_gain)),
        "disk_phase_deg": json_holds(degree_size(loop.robust.disk_phase)),
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
    if loop.linearised is not None:
        facts = loop.linearised
        entry["linearised"] = {
            "states": facts.states,
            "period_s": facts.period,
            "plateau": facts.plateau,
            "doubtful": list(facts.doubtful),
            "periodicity": facts.periodicity,
        }
    if loop.measured_response is not None:
        facts_b = loop.measured_response
        entry["measured_response"] = {
            "amplitude": facts_b.amplitude,
            "lines": facts_b.lines,
            "period_s": facts_b.period,
            "half_amplitude_change": facts_b.half_amplitude_change,
            "unexcited": facts_b.unexcited,
            "frequency_rad_s": [float(value) for value in facts_b.curve.frequency],
            "L": _complex(facts_b.curve.value),
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


def _requirement(item: Requirement) -> dict[str, Any]:
    return {
        "scope": item.scope,
        "quantity": item.quantity,
        "value": _size(item.value),
        "limit": item.limit,
        "unit": item.unit,
        "passed": {Verdict.PASS: True, Verdict.FAIL: False}.get(item.verdict),
        "verdict": item.verdict,
        "note": item.note,
        **({"as_feedthrough": _requirement(item.as_feedthrough)} if item.as_feedthrough is not None else {}),
    }


def _element(item: Nonlinearity) -> dict[str, Any]:
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


def _dispersion(item: Dispersion) -> dict[str, Any]:
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


def _joint(joint: JointReport) -> dict[str, Any]:
    def json_holds(value: float) -> float | str | None:
        return _size(value if joint.stable else UNSTABLE)

    return {
        "name": joint.name,
        "point": joint.point,
        "channels": list(joint.channels),
        "stable": joint.stable,
        "verdict": joint.verdict,
        "disk_margin": json_holds(joint.disk_margin),
        "disk_gain_db": json_holds(decibels(joint.disk_gain)),
        "disk_phase_deg": json_holds(degree_size(joint.disk_phase)),
        "frequency_rad_s": joint.disk_frequency,
        "requirements": [_requirement(item) for item in joint.requirements],
    }


def _sweep(sweep: SweepReport) -> dict[str, Any]:
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


def _point(point: PointReport) -> dict[str, Any]:
    return {
        "name": point.name,
        "phase": point.phase,
        "time_s": point.time,
        "settings": {name: str(value) for name, value in point.settings.items()},
        "drift": point.drift,
        "holds_s": point.holds,
    }
