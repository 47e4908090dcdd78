"""Powered descent: constant thrust along a fixed line, on propellant that it consumes, over the Moon."""

from crosscheck.case import MASS, POSITION, VELOCITY, Case

MU, RADIUS = 4.9028e12, 1737400.0  # m3/s2, m
START, SPEED = (0.0, 0.0, 15e3), (1690.0, 0.0, 0.0)  # m and m/s, landing site frame
THRUST, DIRECTION = 2062.0, (-0.96, 0.0, 0.28)  # N; unit vector
INITIAL_MASS, PROPELLANT, SPECIFIC_IMPULSE, GRAVITY = 940.0, 500.0, 319.0, 9.80665  # kg, kg, s, m/s2
FLOW = THRUST / (GRAVITY * SPECIFIC_IMPULSE)  # kg/s

CASE = Case(
    title="descent with thrust and depletion",
    verifies="motion and mass of spherical_moon_lander under thrust",
    gravitation="point mass, 4.9028e12 m3/s2",
    environment="none",
    integrator="Runge-Kutta-Nystrom of fourth order here, Runge-Kutta of fourth order in Basilisk",
    matched="in Basilisk an external force, and a tank at the centre of mass that leaks what the engine burns; here an "
    "engine without lag and an attitude without response time",
    step=0.1,
    duration=200.0,
    quantities={"position": POSITION, "velocity": VELOCITY, "mass": MASS},
    bounds={"position": 1e-7, "velocity": 1e-9, "mass": 1e-9},
)
