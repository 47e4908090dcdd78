"""Transfer between two hovers as JSON: times in s, angles in deg, propellant in kg and over the initial mass."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import asdict

from ....design.trajectories.path import PlannedPath
from ....design.trajectories.vehicle import limits_document
from ....design.transfers.hover_study import HoverStudy, PropellantCurve

NAMES = ("t2_s", "t5_s", "w_s", "tp_s", "t7_s")


def transfer_json(study: HoverStudy) -> dict[str, object]:
    """Return a study as JSON for other programs."""
    programme = study.programme
    minimum, largest = (math.degrees(angle) for angle in programme.extremes)
    return {
        "vehicle": limits_document(study.vehicle),
        "margins": None if study.margins is None else limits_document(study.margins),
        "transfer": asdict(study.transfer),
        "programme": {
            "kind": programme.kind,
            "duration_given": study.is_duration_set,
            **dict(zip(NAMES, programme.times, strict=True)),
            "k": programme.threshold,
            **_propellant(study, programme.propellant_fraction),
            "least_pitch_deg": minimum,
            "largest_pitch_deg": largest,
            "largest_pitch_rate_deg_s": math.degrees(programme.turn_rate),
            "full_thrust_s": _burns(programme.burns),
            "over_vertical": programme.propellant_fraction / study.vertical.propellant_fraction,
        },
        "vertical": {"t7_s": study.vertical.duration, **_propellant(study, study.vertical.propellant_fraction)},
        "true_optimum": _path(study, study.optimum),
        "bound": _path(study, study.bound),
        "over_duration": _curve(study.durations, "t7_s"),
        "over_distance": _curve(study.distances, "distance_m"),
        "adjoint": None if study.adjoint is None else study.adjoint.document(),
        "finite_switches": _finite(study),
        "free_fall": _free_fall(study),
        "free_fall_over_distance": [
            {name: _known(number) for name, number in asdict(each).items()} for each in study.comparisons
        ],
    }


def _finite(study: HoverStudy) -> dict[str, object] | None:
    profile = study.finite
    if profile is None:
        return None
    return {
        **dict(zip(("t2_s", "t3_s", "t4_s", "t5_s", "t7_s"), profile.times, strict=True)),
        **_propellant(study, profile.propellant_fraction),
        "full_thrust_s": _burns(profile.full_thrust),
    }


def _free_fall(study: HoverStudy) -> dict[str, object] | None:
    programme = study.free_fall
    if programme is None:
        return None
    return {
        **dict(zip(NAMES, programme.times.elements(), strict=True)),
        "free_fall_s": programme.fall,
        "last_burn_s": programme.last_burn,
        "duration_s": programme.duration,
        "drop_m": programme.drop,
        **_propellant(study, programme.propellant_fraction),
        "full_thrust_s": _burns(programme.full_thrust),
    }


def _propellant(study: HoverStudy, fraction: float) -> dict[str, float]:
    return {"propellant_fraction": fraction, "propellant_kg": fraction * study.vehicle.mass}


def _burns(burns: Iterable[tuple[float, float]]) -> list[list[float]]:
    return [list(burn) for burn in burns]


def _path(study: HoverStudy, path: PlannedPath | None) -> dict[str, object] | None:
    if path is None:
        return None
    return {
        "duration_s": path.duration,
        **_propellant(study, path.propellant_fraction),
        "intervals": path.throttle.size,
        "full_thrust_s": _burns(path.burns()),
    }


def _curve(curve: PropellantCurve | None, name: str) -> dict[str, list[float] | list[float | None]] | None:
    if curve is None:
        return None
    fractions = [_known(float(fraction)) for fraction in curve.propellant]
    return {name: [float(at) for at in curve.at], "propellant_fraction": fractions}


def _known(number: float) -> float | None:
    """Return a number for JSON, with NaN as None."""
    return None if math.isnan(number) else number
