"""Document of the propellant bound of a single-burn braking and landing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path

from ....design.trajectories.landing_study import LandingStudy
from ....design.trajectories.vehicle import limits_document
from ...cell import Cell, Inline, Phrase, Quantity
from ...model import Document, KeyNumbers, Node, Note, Section, Text
from ...pictures import Figures
from .plan_figures import bound_figure, bound_series, time_figures
from .transfer import burns_phrase

PITCH = "Angle of thrust above the site's horizontal, deg"


def landing_bound_document(study: LandingStudy, file: Path | None = None) -> Document:
    """Return the document of a bound: propellant, verification, trajectory; ``file`` stores the bound, if stated."""
    bound, series = study.bound, bound_series(study)
    numbers: list[tuple[str, Cell]] = [
        ("propellant", Quantity(study.propellant, "kg", 6)),
        ("of a mass of", Quantity(study.vehicle.mass, "kg", 6)),
        ("duration", Quantity(bound.duration, "s", 5)),
        ("full thrust", Phrase([*burns_phrase(bound.burns()), " s"])),
        ("intervals", bound.throttle.size),
    ]
    summary: list[Node] = [
        Text(
            "lower bound of the propellant from this start to rest at the site: a point mass with unconstrained thrust "
            "direction"
        ),
        KeyNumbers(numbers),
        Note(_limits(study)),
        *(Text(each) for each in _checks(study)),
        *([] if file is None else [Text(f"stored: {file}")]),
    ]
    path = Note(
        "Dot: end. Arrows: thrust relative to the local horizontal at equally spaced times while the engine is on."
    )
    sections = [
        Section("Path", [Figures(partial(bound_figure, study, series)), path]),
        Section("Over time", [Figures(partial(time_figures, series, PITCH))]),
    ]
    return Document("Bound of braking and landing", summary, sections, _json(study))


def _limits(study: LandingStudy) -> Sequence[Inline]:
    landing, vehicle = study.landing, study.vehicle
    return [
        "Range ", Quantity(landing.range, "m", 6), ", altitude ", Quantity(landing.altitude, "m", 6), "; speed ",
        Quantity(landing.speed, "m/s", 7), ", ", Quantity(landing.climb, "rad"), " above the horizontal; target ",
        Quantity(landing.target_altitude, "m"), " over the site; specific impulse ",
        Quantity(vehicle.specific_impulse, "s"), "; thrust ", Quantity(vehicle.minimum_thrust, digits=6), " to ",
        Quantity(vehicle.maximum_thrust, "N", 6), "; Moon: radius ", Quantity(landing.radius, "m", 6),
        ", gravitational parameter ", Quantity(landing.gravitational_parameter, "m3/s2", 6), ".",
    ]  # fmt: skip


def _checks(study: LandingStudy) -> list[Sequence[Inline]]:
    """Return the residual of the convex form, the bounds of its stages, and the result of the direct method."""
    sentences: list[Sequence[Inline]] = [
        ["largest thrust residual of the convex form: ", Quantity(study.looseness, "m/s2", 1)]
    ]
    sentences += [[f"{name} alone: ", Quantity(propellant, "kg", 6)] for name, propellant in study.pieces.items()]
    if study.direct is not None:
        propellant = study.direct.propellant_fraction * study.vehicle.mass
        sentences.append(
            [
                "direct method, without the convex form: ", Quantity(propellant, "kg", 6), " in ",
                Quantity(study.direct.duration, "s", 5), ", ", Quantity(propellant - study.propellant, "kg", 2),
                " compared with the bound",
            ]
        )  # fmt: skip
    return sentences


def _json(study: LandingStudy) -> dict[str, object]:
    """Return a study as JSON for other programs: in SI, except angular acceleration."""
    bound, direct = study.bound, study.direct
    return {
        "vehicle": limits_document(study.vehicle),
        "landing": asdict(study.landing),
        "bound": {
            "duration_s": bound.duration,
            "propellant_fraction": bound.propellant_fraction,
            "propellant_kg": study.propellant,
            "intervals": bound.throttle.size,
            "full_thrust_s": [list(burn) for burn in bound.burns()],
            "looseness_m_s2": study.looseness,
        },
        "pieces_kg": dict(study.pieces),
        "direct_method": None
        if direct is None
        else {
            "duration_s": direct.duration,
            "propellant_fraction": direct.propellant_fraction,
            "propellant_kg": direct.propellant_fraction * study.vehicle.mass,
        },
    }
