"""Drag and solar pressure brake and turn a spacecraft of four plates in a very low orbit, by day."""

from crosscheck.case import ATTITUDE, POSITION, RATE, VELOCITY, Case
from crosscheck.models.surfaces.case import PLATES as SMALL

MU, RADIUS = 3.986004415e14, 6378137.0  # m3/s2, m
START, SPEED = (6728137.0, 0.0, 0.0), (0.0, -991.0, 7633.0)  # m, m/s, inertial
DENSITY, HEIGHT, SCALE_HEIGHT = 9.518e-12, 350e3, 53298.0  # kg/m3 at a height (m); m
MASS, INERTIA = 50.0, ((4.2, -0.05, 0.02), (-0.05, 4.0, 0.03), (0.02, 0.03, 3.0))  # kg, kg m2
QUATERNION, ANGULAR_VELOCITY = (0.5, 0.5, -0.1, 0.7), (0.002, -0.003, 0.001)  # body to inertial; rad/s, body
SUNLIGHT = 30.0  # factor on the areas for light, whose drag coefficients have its inverse: as strong as drag
LARGER = 1368.0 / 1361.0  # of Basilisk's solar constant
PLATES = tuple(
    (SUNLIGHT * area, *others, coefficient / SUNLIGHT, specular, diffuse)
    for area, *others, coefficient, specular, diffuse in SMALL
)

CASE = Case(
    title="drag and solar pressure in a low orbit",
    verifies="spacecraft: drag and solar pressure on plates in its stages, their torques, air that turns along",
    gravitation="point mass, 3.986004415e14 m3/s2, and its gradient",
    environment="exponential air about a sphere, Sun, no shadow on the way",
    integrator="Runge-Kutta of fourth order; quaternion and inertial angular momentum here, MRP and rate in Basilisk",
    matched="here by a class that overrides the density; plates 30 times as large with coefficients of drag of a "
    "thirtieth, so that light is as strong as air; ours larger by 1368/1361, since Basilisk has 1368 W/m2; in "
    "Basilisk density and wind of a step are those of its middle",
    step=1.0,
    duration=600.0,
    quantities={"position": POSITION, "velocity": VELOCITY, "attitude": ATTITUDE, "rate": RATE},
    bounds={"position": 1e-7, "velocity": 5e-10, "attitude": 3e-7, "rate": 5e-9},
)
