"""A tumbling body with four gyros, whose gimbals rotate at constant rates."""

from crosscheck.case import ATTITUDE, RATE, Case

MASS, INERTIA = 1000.0, (812.0, 587.0, 910.0)  # kg; kg m2 of body and gyros, principal
ROTOR_MOMENTUM = 30.0  # N m s
GIMBAL_ANGLES = (0.3, 1.9, 3.4, 1.1)  # rad, at the start
GIMBAL_RATES = (0.02, -0.02, 0.013, -0.013)  # rad/s; opposite in pairs, so that momenta of gimbals cancel
QUATERNION, ANGULAR_VELOCITY = (0.9, 0.1, -0.3, 0.3), (0.002, -0.015, 0.008)  # body to inertial; rad/s, body
GYRO_INERTIA, WHEEL_INERTIA = 1.0, 0.1  # kg m2: of a gyro about each axis, of its wheel about its spin axis

CASE = Case(
    title="gyros with rotating gimbals",
    verifies="free_flying_robot under its gyros: their momentum over the gimbal angles, its rate, its coupling with "
    "the rotation",
    gravitation="none",
    environment="none",
    integrator="Runge-Kutta of fourth order; quaternion and inertial angular momentum here, MRP and rate in Basilisk",
    matched="constant gimbal rates, opposite within a pair; in Basilisk balanced VSCMGs with equal moments of inertia, "
    "which are part of the inertia here, and drives that set the torques on wheels and gimbals at each step so that "
    "their rates stay constant",
    step=0.125,
    duration=100.0,
    quantities={"attitude": ATTITUDE, "rate": RATE},
    bounds={"attitude": 2e-6, "rate": 5e-7},
)
