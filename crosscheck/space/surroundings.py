"""Surroundings of a spacecraft over a flight, as our plant has them, for Basilisk's side."""

import numpy as np

from perilune.fmus_src.mathlib.space import earth_gravity, ephemerides
from perilune.fmus_src.mathlib.space.orientation import earth_axes, fixed_axes

EPOCH, TT_MINUS_UT1 = 827301600.0, 69.184  # s


def surroundings(step: float, duration: float, turns: bool = True, epoch: float = EPOCH, at: float = 0.0) -> dict:
    """Return Earth, Sun and Moon for each step (s) of a flight: those of its middle, as `spacecraft` holds them.

    The axes of the Earth (by rows, inertial) are those at the begin of each step, or after a fraction ``at`` of it,
    about the pole of its middle, with their rate; without ``turns`` they do not turn within a step. Coefficients of
    gravity go with them.
    """
    given: dict = {
        "normalised": list(earth_gravity.NORMALISED),
        "radius": earth_gravity.RADIUS,
        "earth_mu": earth_gravity.GRAVITATIONAL_PARAMETER,
        "sun_mu": ephemerides.SUN_PARAMETER,
        "moon_mu": ephemerides.MOON_PARAMETER,
        **{name: [] for name in ("sun", "moon", "axes", "axes_rate")},
    }
    for k in range(round(duration / step)):
        middle = epoch + (k + 0.5) * step
        given["sun"].append(ephemerides.sun_position(middle).elements())
        given["moon"].append(ephemerides.moon_position(middle).elements())
        pole = earth_axes(middle, TT_MINUS_UT1)
        axes = fixed_axes(pole, epoch + (k + at) * step)
        rows = np.array([axes.meridian.elements(), axes.east.elements(), axes.pole.elements()])
        rate = pole.rate * np.array([rows[1], -rows[0], np.zeros(3)])
        given["axes"].append(rows.tolist())
        given["axes_rate"].append((rate if turns else np.zeros((3, 3))).tolist())
    return given
