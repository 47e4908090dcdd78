"""A capsule brakes and swings about its trim in thin air over the rotating Earth."""

import math

from crosscheck.case import ATTITUDE, POSITION, RATE, VELOCITY, Case

MU, EARTH_RATE, EARTH_RADIUS = 3.986e14, 7.29e-5, 6371000.0  # m3/s2, rad/s, m
MASS, INERTIA = 2900.0, ((1400.0, -40.0, 0.0), (-40.0, 1250.0, 0.0), (0.0, 0.0, 1200.0))  # kg, kg m2
AREA, DRAG_COEFFICIENT, ARM = 3.8, 1.7, (-0.025, -0.0091, 0.002)  # m2; 1; m, body, to the centre of pressure
HEIGHTS, DENSITIES = (90000.0, 95000.0), (3.416e-6, 1.393e-6)  # m, kg/m3: between them the density is exponential
DENSITY_FACTOR = 400.0  # at which the air brakes as it does near 50 km
HEIGHT, LONGITUDE, LATITUDE = 94800.0, math.radians(60.0), math.radians(45.0)  # m, rad, rad
SPEED, FLIGHT_PATH_ANGLE, HEADING = 7500.0, math.radians(-0.6), math.radians(40.0)  # m/s, rad, rad
ATTITUDE_ANGLES = (1.0, 0.1, -0.25)  # rad: bank, sideslip, angle of attack
ANGULAR_VELOCITY = (0.05, -0.02, 0.03)  # rad/s, absolute, body

CASE = Case(
    title="capsule in the upper atmosphere",
    verifies="entry_capsule: motion over the rotating Earth and attitude by angles, drag and its moment at angles of "
    "attack to 29 deg, products of inertia",
    gravitation="point mass, 3.986e14 m3/s2",
    environment="air that rotates with the Earth, exponential from 94.8 to 92 km, 400 times as dense as the standard",
    integrator="Runge-Kutta of fourth order; radius, angles and speed over the rotating Earth here, inertial position "
    "and MRP in Basilisk",
    matched="the block's tables of coefficients are those of a force against the velocity (cosine and sine), which is "
    "Basilisk's drag; in Basilisk density and wind of a step are those of its middle; without lift, damping, jets and "
    "Mach number",
    step=0.2,
    duration=30.0,
    quantities={"position": POSITION, "velocity": VELOCITY, "attitude": ATTITUDE, "rate": RATE},
    bounds={"position": 0.1, "velocity": 5e-4, "attitude": 1e-4, "rate": 1e-4},
)
