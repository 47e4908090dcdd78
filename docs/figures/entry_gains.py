"""Gains of the entry capsule's output feedback, from its aerodynamic table: `make gains` writes its parameter sets.

Bank, sideslip and two rates at trim, at constant pressure q, with measured bank, wx and wy:

    bank' = c0 wx - s0 wy, sideslip' = s0 wx + c0 wy, J (wx', wy')' = q m sideslip + (ux, uy)

The poles -0.35, -0.6, -0.7 +- 0.8i are distributed over the levels in four ways.

The whole attitude, for comparison: bank, sideslip, angle of attack and three rates at trim, turning with the velocity,
measured bank and rates, three torques: m + p = 7 > 6, so the poles can be placed. The angle of attack is coupled to the
other states only by the slow turn of the flight path, which makes this gain impractical.

Source: Lapin, thesis, chapters 2 and 3.2; numbers ours: docs/systems/entry_attitude.md.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import fsolve

from perilune.analysis.design.poles.zeroth_level import output_feedback_levels
from perilune.common.atomic import write_atomically
from perilune.common.paths import ROOT
from perilune.fmus_src.evidence.parameter_set import write_parameter_set
from perilune.fmus_src.kernel.records import replace
from perilune.fmus_src.mathlib.entry.motion import body_axes, in_body
from perilune.fmus_src.mathlib.entry.standard_atmosphere import Air, air
from perilune.fmus_src.mathlib.vectors import cross, vector
from perilune.fmus_src.plants.entry_capsule import EntryCapsule

TRIM = math.radians(-20.0)
MACH = 25.9  # at 75 km, the design point of a single gain
DESIGN_PRESSURE = 1147.0  # Pa, there
SCHEDULE = (600.0, 1200.0, 2400.0)  # Pa
REAL, PAIR = (-0.35, -0.6), (-0.7, 0.8)
TURNING = np.array([[PAIR[0], -PAIR[1]], [PAIR[1], PAIR[0]]])
SYSTEM = ROOT / "ssp_systems" / "entry_attitude"
HEIGHT = 75000.0  # m, where DESIGN_PRESSURE is flown
PATH_ANGLE = math.radians(-1.36)  # of the nominal flight there, as the course
COURSE = math.radians(31.0)
BANK = math.radians(60.0)
UPPER = np.diag([-0.35, -0.6, -0.5])
LOWER = [-0.6, complex(-0.7, 0.8), complex(-0.7, -0.8)]
DIFFERENCE = 1e-5  # rad and rad/s, of the central differences; 1e-4 and 1e-6 give the same eight digits


def sideslip_moments() -> tuple[float, float]:
    """Return aerodynamic moments about x and y (N m) per pressure (Pa) and sideslip (rad), at trim.

    Computed by central differences, and rounded like the model in the documentation: to four and three decimals.
    """
    capsule = EntryCapsule()
    capsule.initialize()
    h, moments = 1e-4, []
    for sideslip in (h, -h):
        v = in_body(body_axes(vector(0.0, sideslip, TRIM)), vector(1.0, 0.0, 0.0))
        # a density of 2 and a speed of 1 give a dynamic pressure of 1
        moments.append(cross(capsule.pressure_arm, capsule.air_force(v, Air(density=2.0, speed_of_sound=1.0 / MACH))))
    x, y, _ = (moments[0] - moments[1]) / (2.0 * h)
    return round(x, 4), round(y, 3)


def plant(pressure: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return A, B, C at a pressure (Pa): states bank, sideslip, wx, wy; torques ux, uy; outputs bank, wx, wy."""
    inertia = np.reshape(EntryCapsule().inertia, (3, 3))[:2, :2]
    a = np.zeros((4, 4))
    a[0, 2:], a[1, 2:] = [math.cos(TRIM), -math.sin(TRIM)], [math.sin(TRIM), math.cos(TRIM)]
    a[2:, 1] = np.linalg.solve(inertia, pressure * np.array(sideslip_moments()))
    return a, np.vstack([np.zeros((2, 2)), np.linalg.inv(inertia)]), np.delete(np.eye(4), 1, axis=0)


def direct(pressure: float, upper: np.ndarray, lower: list[complex]) -> np.ndarray:
    """Return the gain F of the direct plant, with the matrix ``upper`` on the level (bank, sideslip)."""
    return output_feedback_levels(*plant(pressure), upper, lower, basis=np.eye(4)[:, :2]).gain


def dual(pressure: float, upper: float, lower: list[complex]) -> np.ndarray:
    """Return the gain F of the dual plant, with one real pole on its upper level."""
    a, b, c = plant(pressure)
    return output_feedback_levels(a.T, c.T, b.T, [[upper]], lower).gain.T


def sideslip_block(pressure: float) -> np.ndarray:
    """Return [x -y; y x] for the roots x +- iy of p^2 + min(1.4 w, 1) p + w^2.

    w (rad/s) is the natural frequency of the sideslip.
    """
    a, _, _ = plant(pressure)
    square = -float(np.array([math.sin(TRIM), math.cos(TRIM)]) @ a[2:, 1])
    damping = 0.5 * min(1.4 * math.sqrt(square), 1.0)
    swing = math.sqrt(square - damping * damping)
    return np.array([[-damping, -swing], [swing, -damping]])


def entry_gains() -> dict[str, np.ndarray]:
    """Return gains F (SI; rows torques x, y; columns bank, wx, wy) by name; scheduled ones are stacked."""
    pair = [complex(*PAIR), complex(PAIR[0], -PAIR[1])]
    slow, fast = REAL
    return {
        "direct1": direct(DESIGN_PRESSURE, TURNING, [slow, fast]),
        "direct0": direct(DESIGN_PRESSURE, np.diag(REAL), pair),
        "dual_a": dual(DESIGN_PRESSURE, fast, [slow, *pair]),
        "dual_b": dual(DESIGN_PRESSURE, slow, [fast, *pair]),
        "scheduled": np.vstack([direct(q, sideslip_block(q), [slow, fast]) for q in SCHEDULE]),
    }


DESCRIPTIONS = {
    "direct1": "One gain for all pressures: the complex pair on bank and sideslip, the real poles on the lower level.",
    "direct0": "One gain for all pressures: the real poles on bank and sideslip, the complex pair on the lower level.",
    "dual_a": "One gain for all pressures, by the dual plant: the faster real pole on the upper level.",
    "dual_b": "One gain for all pressures, by the dual plant: the slower real pole on the upper level.",
    "scheduled": "Gains over the logarithm of dynamic pressure; the poles follow the sideslip's own oscillation.",
}


def gain_parameters(name: str, gain: np.ndarray) -> dict[str, float]:
    """Return parameters of the block output_feedback in the component ``regulator``; gains have four decimals."""
    pressures = SCHEDULE if name == "scheduled" else (DESIGN_PRESSURE,) * 3
    values = {f"regulator.pressures[{k}]": pressure for k, pressure in enumerate(pressures, 1)}
    for row, entries in enumerate(np.resize(gain, (6, 3)).tolist(), 1):
        for column, entry in enumerate(entries, 1):
            values[f"regulator.gains[{row},{column}]"] = round(entry, 4)
    return values


def gain_files() -> dict[str, bytes]:
    """Return the parameter sets of entry_attitude with these gains, by file name."""
    return {
        f"output_feedback_{name}.ssv": write_parameter_set(
            f"output_feedback_{name}", gain_parameters(name, gain), DESCRIPTIONS[name]
        )
        for name, gain in entry_gains().items()
    }


def whole_model() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return A, B, C in SI: states bank, sideslip, attack, wx, wy, wz; three torques; outputs bank, wx, wy, wz."""
    density = air(HEIGHT).density
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
    """Return F (3, 4), torques (N m) from bank (rad) and rates (rad/s), for the poles UPPER and LOWER."""
    return output_feedback_levels(*whole_model(), UPPER, LOWER).gain


if __name__ == "__main__":
    for file, content in gain_files().items():
        write_atomically(SYSTEM / file, content)
    print(f"whole model: |F| = {np.linalg.norm(whole_gain()):.4g}")
