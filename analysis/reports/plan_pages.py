"""The pages of planned trajectories: a hover transfer, and the propellant bound of a landing."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..design.trajectories.hover_study import HoverStudy
from ..design.trajectories.landing_study import LandingStudy
from .common.page import write_page
from .common.panels import swatch
from .common.style import look
from .plan_figures import Point, Series, curve_panel, path_panel, path_widths, time_panels

NAMES = ("simplified programme", "true optimum", "point-mass bound")


def write_hover_page(study: HoverStudy, path: Path) -> None:
    """Write one self-contained HTML page; the same study gives the same bytes. It needs the study's curves."""
    assert study.durations is not None
    assert study.distances is not None
    plans = zip(NAMES, (study.path, study.optimum, study.bound), strict=True)
    series = [Series(name, plan, look(index)) for index, (name, plan) in enumerate(plans) if plan is not None]
    own = Point(NAMES[0], study.programme.duration, study.programme.propellant_fraction, look(0))
    compared = [Point(one.name, one.path.duration, one.path.propellant_fraction, one.look) for one in series[1:]]
    here = Point(NAMES[0], study.transfer.distance, own.propellant, look(0))
    displayed = [np.stack([*one.path.position.T, _at_ends(one.path.pitch)]) for one in series]
    write_page(
        path,
        Path(__file__).with_name("hover_transfer.html"),
        title="Hover transfer",
        study=study,
        programme=study.programme,
        degrees=math.degrees,
        times=list(zip(("t2", "t5", "w", "tp", "t7"), study.programme.times, strict=True)),
        looks=[(swatch(one.look), one.name) for one in series],
        rows=[(swatch(one.look), one.name, one.path) for one in series],
        missing=[name for name, plan in zip(NAMES[1:], (study.optimum, study.bound), strict=True) if plan is None],
        track=[path_panel(series, displayed, ("along", "up"))],
        over_time=time_panels(series, "Pitch from the horizontal, deg"),
        curves=[
            curve_panel("Propellant over t7", "durations", study.durations, "t7, s", [own, *compared]),
            curve_panel("Least propellant over distance", "distances", study.distances, "distance, m", [here]),
        ],
    )


def _at_ends(values: np.ndarray) -> np.ndarray:
    """A row of intervals with one value more, so that it stands beside rows of their ends."""
    return np.append(values, values[-1])


def write_landing_page(study: LandingStudy, path: Path) -> None:
    """Write one self-contained HTML page; the same study gives the same bytes."""
    series = [Series("bound", study.bound, look(0))]
    radius = study.landing.radius
    x, y = study.bound.position[:, 0], study.bound.position[:, 1] + radius
    central = np.arctan2(x, y)
    turned = study.bound.pitch + (central[1:] + central[:-1]) / 2.0  # from the local horizontal
    displayed = np.stack([radius * central, np.hypot(x, y) - radius, np.append(turned, turned[-1])])
    write_page(
        path,
        Path(__file__).with_name("landing_bound.html"),
        title="Bound of braking and landing",
        study=study,
        direct=None if study.direct is None else study.direct.propellant_fraction * study.vehicle.mass,
        climb=math.degrees(study.landing.climb),
        burns=study.bound.burns(),
        track=path_widths(series, [displayed], ("range from the site", "altitude")),
        over_time=time_panels(series, "Angle of thrust above the site's horizontal, deg"),
    )
