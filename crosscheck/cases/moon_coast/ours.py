"""The coast by spherical_moon_lander."""

from crosscheck.cases.moon_coast.case import APOAPSIS, CASE, MU, RADIUS, SPEED
from crosscheck.perilune_side import fly
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate a coast: the lander has no command."""
    parameters = {
        "initial_position": [0.0, 0.0, APOAPSIS - RADIUS],
        "initial_velocity": [SPEED, 0.0, 0.0],
        "gravitational_parameter": MU,
        "moon_radius": RADIUS,
        "internal_step": step,
    }
    outputs = {"position": "position", "velocity": "velocity"}
    return fly("spherical_moon_lander", step, CASE.duration, parameters, outputs)
