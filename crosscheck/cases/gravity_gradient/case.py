"""A spacecraft librates on a circular orbit under the gravity gradient, and its jets turn it in pulses."""

from crosscheck.case import ATTITUDE, RATE, Case

ORBITAL_RATE, MU = 0.0011, 3.986004418e14  # rad/s, m3/s2
RADIUS = (MU / ORBITAL_RATE**2) ** (1.0 / 3.0)  # m
INERTIA = ((6500.0, -150.0, -100.0), (-150.0, 30000.0, -200.0), (-100.0, -200.0, 29000.0))  # kg m2
ANGLES = (0.15, -0.1, 0.2)  # rad: roll, yaw, pitch at the start
ANGULAR_VELOCITY = (2e-4, -1e-4, -0.0011)  # rad/s, absolute, body
TORQUE = (60.0, 120.0, 120.0)  # N m, of a jet about x, y, z
PULSES = ((100.0, (1.0, -0.5, 0.0)), (200.0, (-1.0, 0.0, 0.25)))  # s: when they start, their lengths with sign

CASE = Case(
    title="gravity gradient with pulses",
    verifies="orbital_spacecraft: gravity gradient, products of inertia, rotating frame, jets in pulses",
    gravitation="point mass, 3.986004418e14 m3/s2, circular orbit of 0.0011 rad/s",
    environment="none",
    integrator="Runge-Kutta of fourth order; angles and rate here, MRP and rate in Basilisk",
    matched="pulses of whole steps, in Basilisk as an external torque that changes between steps; Basilisk integrates "
    "the orbit, here it is a circle; attitudes relative to the inertial frame",
    step=0.125,
    duration=600.0,
    quantities={"attitude": ATTITUDE, "rate": RATE},
    bounds={"attitude": 1e-12, "rate": 1e-15},
)
