"""Magnetorquers and a residual dipole turn a spacecraft in a low orbit."""

from crosscheck.case import ATTITUDE, RATE, Case
from crosscheck.space.points import LOW_ORBIT

MU = 3.986004415e14  # m3/s2
START, SPEED = LOW_ORBIT
MASS, INERTIA = 800.0, ((180.0, -4.0, 2.0), (-4.0, 150.0, 3.0), (2.0, 3.0, 120.0))  # kg, kg m2
QUATERNION, ANGULAR_VELOCITY = (0.5, 0.5, -0.1, 0.7), (0.02, -0.03, 0.01)  # body to inertial; rad/s, body
COMMANDS = (  # s, A m2: when dipoles begin; the limit cuts some
    (0.0, (150.0, -60.0, 90.0)),
    (200.0, (-70.0, 250.0, 20.0)),
    (400.0, (0.0, -100.0, -220.0)),
)
LIMIT, RESIDUAL = 200.0, (3.0, -2.0, 5.0)  # A m2
FIELD_DEGREE = 12

CASE = Case(
    title="magnetorquers in a low orbit",
    verifies="spacecraft: torque of commanded dipoles, their limit, residual dipole, field to degree 12 in its stages",
    gravitation="point mass, 3.986004415e14 m3/s2, and its gradient",
    environment="magnetic field, IGRF-14 at 2025.0 to degree 12, in the axes of the Earth that turns",
    integrator="Runge-Kutta of fourth order; quaternion and inertial angular momentum here, MRP and rate in Basilisk",
    matched="same dipoles, changed between steps; in Basilisk `MtbEffector` with three bars more for the residual "
    "dipole, in the field of `MagneticFieldWMM` in the middle of each step; wheels of 1e-9 kg m2 here",
    step=1.0,
    duration=600.0,
    quantities={"attitude": ATTITUDE, "rate": RATE},
    bounds={"attitude": 1e-5, "rate": 1e-7},
)
