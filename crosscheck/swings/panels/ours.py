"""The flight by spacecraft: a mode by panel."""

import numpy as np

from crosscheck.space.plant import swing_plant
from crosscheck.swings.panels.case import (
    ABOUT_HINGE,
    ARM,
    AXIS,
    CASE,
    CENTRES,
    DAMPING,
    FORCE,
    FREQUENCY,
    INERTIA,
    MASS,
    OUTWARDS,
    PANEL,
    PANEL_INERTIA,
    TORQUE,
)
from crosscheck.table import Table


def simulate(amplitude: float) -> Table:
    """Swing with participation m d/root(Ih) in translation, (Is a + m s x d)/root(Ih) in
    rotation, d the velocity by the rate."""
    root = np.sqrt(ABOUT_HINGE)
    velocities = ARM * np.cross(AXIS, OUTWARDS)
    rotation = (PANEL_INERTIA @ AXIS + PANEL * np.cross(CENTRES, velocities)) / root
    modes = (FREQUENCY, DAMPING, PANEL * velocities / root, rotation, np.full(2, root))
    return swing_plant(modes, (MASS, INERTIA), (amplitude * FORCE, amplitude * TORQUE), CASE.step, CASE.duration)
