"""The flight by spacecraft: a mode by particle."""

import numpy as np

from crosscheck.space.plant import swing_plant
from crosscheck.swings.slosh.case import (
    ALONG,
    CASE,
    DAMPING,
    FORCE,
    FREQUENCY,
    INERTIA,
    MASS,
    PARTICLES,
    POSITIONS,
    TORQUE,
)
from crosscheck.table import Table


def simulate(amplitude: float) -> Table:
    """Swing with participation root(m) p in translation, root(m) s x p in rotation."""
    root = np.sqrt(PARTICLES)
    modes = (FREQUENCY, DAMPING, root[:, None] * ALONG, root[:, None] * np.cross(POSITIONS, ALONG), root)
    return swing_plant(modes, (MASS, INERTIA), (amplitude * FORCE, amplitude * TORQUE), CASE.step, CASE.duration)
