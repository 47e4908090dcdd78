"""The rotation by free_flying_robot."""

from crosscheck.cases.free_rotation.case import ANGULAR_VELOCITY, CASE, INERTIA, QUATERNION
from crosscheck.perilune_side import fly
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate without jets, rotors without momentum."""
    parameters = {
        "inertia": list(INERTIA),
        "rotor_momentum": 0.0,
        "initial_quaternion": list(QUATERNION),
        "initial_angular_velocity": list(ANGULAR_VELOCITY),
        "internal_step": step,
    }
    outputs = {"quaternion": "quaternion", "rate": "angular_velocity"}
    return fly("free_flying_robot", step, CASE.duration, parameters, outputs)
