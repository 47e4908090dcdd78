"""A study as a document for other programs: dB, deg and s, complex numbers as [real, imaginary]."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

import numpy as np

from .assessment import decibel, degrees
from .results import (
    Crossing,
    Dispersion,
    JointReport,
    LoopReport,
    Nonlinearity,
    PointReport,
    Requirement,
    StabilityReport,
    SweepReport,
)


def document(report: StabilityReport) -> dict[str, Any]:
    """The whole report without route A's curves, ready for strict JSON: no number is infinite, absent ones are null."""
    return {
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


def _number(value: float | None) -> float | None:
    return None if value is None or not math.isfinite(value) else float(value)


def _decibel(crossing: Crossing | None) -> float | None:
    return decibel(crossing.value) if crossing else None


def _complex(values: np.ndarray) -> list[list[float]]:
    return [[float(value.real), float(value.imag)] for value in values]


def _loop(loop: LoopReport) -> dict[str, Any]:
    phase = loop.classical.phase_margin
    found: dict[str, Any] = {
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
        "gain_margin_db": _decibel(loop.classical.gain_margin),
        "phase_margin_deg": degrees(phase.value) if phase else None,
        "delay_margin_s": _number(loop.classical.delay_margin),
        "modulus_margin": loop.robust.modulus_margin,
        "disk_margin": loop.robust.disk_margin,
        "disk_gain_db": _number(20.0 * math.log10(loop.robust.disk_gain) if loop.robust.disk_gain < math.inf else None),
        "disk_phase_deg": degrees(loop.robust.disk_phase),
        "sensitivity_peak": loop.robust.sensitivity_peak,
        "complementary_peak": loop.robust.complementary_peak,
        "gain_crossings": [
            {"gain_db": 20.0 * math.log10(item.value), "frequency_rad_s": item.frequency}
            for item in loop.classical.gain
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
                "damping": _number(mode.damping),
                "frequency_rad_s": _number(mode.frequency),
                "kind": mode.kind,
            }
            for mode in loop.modes
        ],
        "requirements": [_requirement(item) for item in loop.requirements],
        "not_applicable": loop.not_applicable,
        "nonlinearities": [_element(item) for item in loop.nonlinearities],
        "sampling": [
            {
                "step_s": item.step,
                "gain_margin_db": _size(item.gain_margin, decibel),
                "phase_margin_deg": _size(item.phase_margin, degrees),
                "note": item.note,
            }
            for item in loop.sampling
        ],
        "amplitudes": [
            {"amplitude": item.amplitude, "L": [item.value.real, item.value.imag], "change": item.change}
            for item in loop.amplitudes
        ],
    }
    if loop.route_a is not None:
        facts = loop.route_a
        found["route_a"] = {
            "states": facts.states,
            "period_s": facts.period,
            "plateau": facts.plateau,
            "doubtful": list(facts.doubtful),
            "periodicity": facts.periodicity,
        }
    if loop.route_b is not None:
        facts_b = loop.route_b
        found["route_b"] = {
            "amplitude": facts_b.amplitude,
            "lines": facts_b.lines,
            "period_s": facts_b.period,
            "half_amplitude_change": facts_b.half_amplitude_change,
            "unexcited": facts_b.unexcited,
            "frequency_rad_s": [float(value) for value in facts_b.curve.frequency],
            "L": _complex(facts_b.curve.value),
        }
    if loop.agreement is not None:
        found["agreement"] = {
            "gain_db": 20.0 * math.log10(loop.agreement.gain),
            "phase_deg": math.degrees(loop.agreement.phase),
            "agrees": loop.agreement.agrees,
        }
    if loop.dispersion is not None:
        found["dispersion"] = _dispersion(loop.dispersion)
    return found


def _size(value: float | None, measure: Any) -> float | None:
    return None if value is None or not math.isfinite(value) else measure(value)


def _requirement(item: Requirement) -> dict[str, Any]:
    return {
        "quantity": item.quantity,
        "value": _number(item.value),
        "limit": item.limit,
        "unit": item.unit,
        "passed": item.passed,
        "note": item.note,
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
    quantiles: dict[str, Any] = {}
    columns = {
        "gain_margin_db": abs(20.0 * np.log10(item.gain_margin)),
        "phase_margin_deg": abs(np.degrees(item.phase_margin)),
        "modulus_margin": item.modulus_margin,
        "disk_margin": item.disk_margin,
    }
    for name, values in columns.items():
        known = values[np.isfinite(values)]
        levels = np.quantile(known, (0.0, 0.05, 0.5)) if known.size else (None, None, None)
        quantiles[name] = dict(zip(("least", "5 %", "50 %"), map(_number, levels), strict=True))
    return {
        "campaign": item.campaign,
        "trials": item.trials,
        "stable_trials": int(np.sum(item.stable)),
        **quantiles,
        "worst_trial": item.worst,
        "replay": item.replay,
        "requirements": [_requirement(entry) for entry in item.requirements],
    }


def _joint(joint: JointReport) -> dict[str, Any]:
    return {
        "name": joint.name,
        "point": joint.point,
        "channels": list(joint.channels),
        "disk_margin": joint.disk_margin,
        "disk_gain_db": _number(20.0 * math.log10(joint.disk_gain) if joint.disk_gain < math.inf else None),
        "disk_phase_deg": degrees(joint.disk_phase),
        "frequency_rad_s": joint.disk_frequency,
        "requirements": [_requirement(item) for item in joint.requirements],
    }


def _sweep(sweep: SweepReport) -> dict[str, Any]:
    return {
        "name": sweep.name,
        "loop": sweep.loop,
        "parameter": sweep.parameter,
        "values": [float(value) for value in sweep.values],
        "gain_margin_db": [_size(float(value), decibel) for value in sweep.gain_margin],
        "phase_margin_deg": [_size(float(value), degrees) for value in sweep.phase_margin],
        "crossings": sweep.crossings,
    }


def _point(point: PointReport) -> dict[str, Any]:
    return {
        "name": point.name,
        "phase": point.phase,
        "time_s": point.time,
        "settings": {name: str(value) for name, value in point.settings.items()},
        "drift": _number(point.drift),
        "holds_s": _number(point.holds),
    }
