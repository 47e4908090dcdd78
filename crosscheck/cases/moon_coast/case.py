"""Coast on the ellipse to which a deorbit burn leads, from 100 km down to 15 km over the Moon."""

from crosscheck.case import POSITION, VELOCITY, Case

MU, RADIUS = 4.9028e12, 1737400.0  # m3/s2, m
APOAPSIS, PERIAPSIS = RADIUS + 100e3, RADIUS + 15e3  # m
SPEED = (2.0 * MU * (1.0 / APOAPSIS - 1.0 / (APOAPSIS + PERIAPSIS))) ** 0.5  # m/s, at the apoapsis

CASE = Case(
    title="deorbit ellipse and coast",
    verifies="motion of spherical_moon_lander without thrust over half a revolution",
    gravitation="point mass, 4.9028e12 m3/s2",
    environment="none",
    integrator="Runge-Kutta-Nystrom of fourth order here, Runge-Kutta of fourth order in Basilisk",
    matched="same start and steps; the frame of the landing site is moved to the Moon's centre",
    step=1.0,
    duration=3400.0,
    quantities={"position": POSITION, "velocity": VELOCITY},
    bounds={"position": 1e-6, "velocity": 1e-9},
)
