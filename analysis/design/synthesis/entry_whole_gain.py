"""The output feedback that places the poles of the capsule's whole attitude, attack included, and how large it is.

Bank, sideslip, attack and three rates at trim, turning with the velocity, measured bank and rates, three torques:
m + p = 7 > 6, so the poles can be placed. Attack hangs on the rest by the slow turn of the flight path alone, which is
why nobody would fly the gain. Source: Lapin, thesis, chapters 2 and 3.2; numbers ours: docs/systems/entry_attitude.md.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import fsolve

from ....fmus_src.kernel.records import replace
from ....fmus_src.mathlib.standard_atmosphere import air
from ....fmus_src.mathlib.vectors import vector
from ....fmus_src.plants.entry_capsule import EntryCapsule
from ..poles.levels import output_feedback_levels
from .entry_gains import DESIGN_PRESSURE, TRIM

HEIGHT = 75000.0  # m, where DESIGN_PRESSURE is flown
PATH_ANGLE = math.radians(-1.36)  # of the nominal flight there, as the course
COURSE = math.radians(31.0)
BANK = math.radians(60.0)
UPPER = np.diag([-0.35, -0.6, -0.5])
LOWER = [-0.6, complex(-0.7, 0.8), complex(-0.7, -0.8)]
DIFFERENCE = 1e-5  # rad and rad/s, of the central differences; 1e-4 and 1e-6 give the same eight digits


def whole_model() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A, B, C of (bank, sideslip, attack, wx, wy, wz), three torques (N m) and outputs (bank, wx, wy, wz), SI."""
    density, _ = air(HEIGHT)
    capsule = EntryCapsule(
        initial_height=HEIGHT,
        initial_speed=math.sqrt(2.0 * DESIGN_PRESSURE / density),
        initial_path_angle=PATH_ANGLE,
        initial_course=COURSE,
        initial_bank=BANK,
        initial_sideslip=0.0,
        initial_attack=TRIM,
    )
    capsule.initialize()

    def rates(state: np.ndarray) -> np.ndarray:
        attitude, w = vector(*state[:3].tolist()), vector(*state[3:].tolist())
        here = replace(capsule.state, attitude=attitude, angular_velocity=w)
        rate = capsule.derivatives(0.0, here, vector(0.0, 0.0, 0.0))
        return np.array([*rate.attitude, *rate.angular_velocity])

    attitude = [*capsule.state.attitude]
    turning = fsolve(lambda w: rates(np.array([*attitude, *w]))[:3], np.zeros(3), xtol=1e-13)
    trim = np.array([*attitude, *turning])
    steps = DIFFERENCE * np.eye(6)
    a = np.array([(rates(trim + step) - rates(trim - step)) / (2.0 * DIFFERENCE) for step in steps]).T
    b = np.vstack([np.zeros((3, 3)), np.reshape(capsule.inverse_inertia, (3, 3))])
    return a, b, np.delete(np.eye(6), [1, 2], axis=0)


def whole_gain() -> np.ndarray:
    """F (3, 4) of torques (N m) over bank (rad) and rates (rad/s) that puts the six poles on UPPER and LOWER."""
    return output_feedback_levels(*whole_model(), UPPER, LOWER).gain
