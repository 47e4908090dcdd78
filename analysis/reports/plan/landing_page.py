"""The page of a landing's bound: what is landed from where, what it takes at least, how that goes."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ...design.trajectories.landing_study import LandingStudy
from ..common.page import write_page
from ..common.style import look
from .figures import Series, path_widths, time_panels


def write_landing_page(study: LandingStudy, path: Path) -> None:
    """Write one self-contained HTML page; the same study gives the same bytes."""
    series = [Series("bound", study.bound, look(0))]
    radius = study.landing.radius
    x, y = study.bound.position[:, 0], study.bound.position[:, 1] + radius
    central = np.arctan2(x, y)
    turned = study.bound.pitch + (central[1:] + central[:-1]) / 2.0  # from the local horizontal
    shown = np.stack([radius * central, np.hypot(x, y) - radius, np.append(turned, turned[-1])])
    write_page(
        path,
        Path(__file__).with_name("landing_bound.html"),
        title="Bound of braking and landing",
        study=study,
        direct=None if study.direct is None else study.direct.propellant_fraction * study.vehicle.mass,
        climb=math.degrees(study.landing.climb),
        burns=study.bound.burns(),
        track=path_widths(series, [shown], ("range from the site", "altitude")),
        over_time=time_panels(series, "Angle of thrust above the site's horizontal, deg"),
    )
