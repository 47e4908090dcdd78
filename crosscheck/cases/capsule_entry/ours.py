"""The entry by entry_capsule."""

import numpy as np

from crosscheck.cases.capsule_entry.case import (
    ANGULAR_VELOCITY,
    AREA,
    ARM,
    ATTITUDE_ANGLES,
    CASE,
    DENSITY_FACTOR,
    DRAG_COEFFICIENT,
    EARTH_RADIUS,
    EARTH_RATE,
    FLIGHT_PATH_ANGLE,
    HEADING,
    HEIGHT,
    INERTIA,
    LATITUDE,
    LONGITUDE,
    MASS,
    MU,
    SPEED,
)
from crosscheck.cases.capsule_entry.frames import to_inertial
from crosscheck.perilune_side import fly
from crosscheck.table import Table

KNOTS, MACH_NUMBERS = np.radians(5.0 * np.arange(13)), 10  # rad; sizes of the block's tables
GEOCENTRIC = ("height", "longitude", "latitude")
MOTION = ("speed", "path_angle", "course")
ANGLES = ("bank", "sideslip", "attack")


def simulate(step: float) -> Table:
    """Simulate: the force of the tables is against the velocity; its table in inertial axes."""
    bank, sideslip_angle, angle_of_attack = ATTITUDE_ANGLES
    parameters = {
        "mass": MASS,
        "inertia": [element for row in INERTIA for element in row],
        "reference_area": AREA,
        "pressure_arm": list(ARM),
        "damping_coefficient": 0.0,
        "axial_coefficient": list(np.tile(DRAG_COEFFICIENT * np.cos(KNOTS), MACH_NUMBERS)),
        "normal_coefficient": list(np.tile(DRAG_COEFFICIENT * np.sin(KNOTS), MACH_NUMBERS)),
        "gravitational_parameter": MU,
        "earth_rate": EARTH_RATE,
        "earth_radius": EARTH_RADIUS,
        "initial_height": HEIGHT,
        "initial_longitude": LONGITUDE,
        "initial_latitude": LATITUDE,
        "initial_speed": SPEED,
        "initial_path_angle": FLIGHT_PATH_ANGLE,
        "initial_course": HEADING,
        "initial_bank": bank,
        "initial_sideslip": sideslip_angle,
        "initial_attack": angle_of_attack,
        "initial_angular_velocity": list(ANGULAR_VELOCITY),
        "internal_step": step,
    }
    outputs = {name: name for name in (*GEOCENTRIC, *MOTION, *ANGLES)} | {"rate": "angular_velocity"}
    commands = {"time": np.array([0.0, CASE.duration]), "density_factor": np.full(2, DENSITY_FACTOR)}
    table = fly("entry_capsule", step, CASE.duration, parameters, outputs, commands)
    table["height"] = table["height"] + EARTH_RADIUS
    rows = (np.stack([table.pop(name) for name in names]) for names in (GEOCENTRIC, MOTION, ANGLES))
    for name, columns in zip(("position", "velocity", "quaternion"), to_inertial(table["time"], *rows), strict=True):
        table.update({f"{name}[{index + 1}]": column for index, column in enumerate(columns)})
    return table
