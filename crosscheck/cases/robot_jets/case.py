"""A rigid body turned and pushed by eight jets that fire for prescribed times."""

import math

from crosscheck.case import ATTITUDE, POSITION, RATE, VELOCITY, Case

MASS, INERTIA = 1000.0, (812.0, 587.0, 910.0)  # kg; kg m2, principal
TILT, AZIMUTH, ARM = 0.6152285613, math.pi / 4.0, (1.0, 0.7, 0.6)  # rad, rad, m
SIGNS = [(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)]  # of the jets' positions, in their order
POSITIONS = [tuple(sign * arm for sign, arm in zip(signs, ARM, strict=True)) for signs in SIGNS]  # m, body
LEVELS = (math.cos(TILT) * math.cos(AZIMUTH), math.cos(TILT) * math.sin(AZIMUTH), math.sin(TILT))
DIRECTIONS = [
    tuple(-sign * level for sign, level in zip(signs, LEVELS, strict=True)) for signs in SIGNS
]  # of forces, body
THRUST = 0.5  # N
TAIL = 1.0 / 6.0  # of a jet's thrust, in the step after its pulse
SURE = 1e-6  # s, added to pulses in Basilisk, so that rounding does not decide their last stage
ON_TIMES = (30.0, 4.0, 12.5, 7.25, 0.0, 21.75, 18.0, 9.5)  # s, from the start
QUATERNION, ANGULAR_VELOCITY = (0.9, 0.1, -0.3, 0.3), (0.002, -0.015, 0.008)  # body to inertial; rad/s, body

CASE = Case(
    title="rigid body with on-time thrusters",
    verifies="translation and rotation of free_flying_robot under its jets, rotors at rest",
    gravitation="none",
    environment="none",
    integrator="Runge-Kutta of fourth order; quaternion and inertial angular momentum here, MRP and rate in Basilisk",
    matched="each jet is on from the start for a whole number of steps. Basilisk judges at each Runge-Kutta stage "
    "whether a thruster is on: at the end of a pulse it still is, which gives the next step a sixth of the impulse; "
    "here a sixth of the thrust for that step",
    step=0.125,
    duration=40.0,
    quantities={"position": POSITION, "velocity": VELOCITY, "attitude": ATTITUDE, "rate": RATE},
    bounds={"position": 2e-6, "velocity": 3e-8, "attitude": 1e-6, "rate": 2e-9},
)
