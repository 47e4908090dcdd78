"""A spacecraft tumbles in the gravity gradient of a low orbit."""

from crosscheck.case import ATTITUDE, POSITION, RATE, VELOCITY, Case
from crosscheck.space.points import LOW_ORBIT

MU = 3.986004415e14  # m3/s2
START, SPEED = LOW_ORBIT
MASS, INERTIA = 800.0, ((180.0, -4.0, 2.0), (-4.0, 150.0, 3.0), (2.0, 3.0, 120.0))  # kg, kg m2
QUATERNION, ANGULAR_VELOCITY = (0.5, 0.5, -0.1, 0.7), (0.002, -0.004, 0.003)  # body to inertial; rad/s, body

CASE = Case(
    title="gravity gradient in a low orbit",
    verifies="spacecraft: gravity gradient with products of inertia, Euler's equations, motion about a point mass",
    gravitation="point mass, 3.986004415e14 m3/s2",
    environment="none",
    integrator="Runge-Kutta of fourth order; quaternion and inertial angular momentum here, MRP and rate in Basilisk",
    matched="wheels of 1e-9 kg m2 here",
    step=1.0,
    duration=5600.0,
    quantities={"position": POSITION, "velocity": VELOCITY, "attitude": ATTITUDE, "rate": RATE},
    bounds={"position": 1e-6, "velocity": 1e-9, "attitude": 1e-6, "rate": 1e-8},
)
