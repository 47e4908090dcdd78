"""Date and orbit as lines of a system.toml: 550 km, sun-synchronous, ascending node at 10:30 mean local time."""

from math import acos, pi, radians, sqrt

import perilune

MU, RADIUS, J2 = 3.986004415e14, 6378136.3, 1.0826356e-3  # m3/s2, m, 1: GGM03S
YEAR = 365.25636 * 86400.0  # s, sidereal
PRECESSION = 1.28118  # deg a century, of right ascension

epoch = perilune.epoch("2027-06-01T00:00:00Z")
a = RADIUS + 550e3
drift = 1.5 * J2 * sqrt(MU / a**3) * (RADIUS / a) ** 2  # of the node over -cos(inclination), rad/s
centuries = epoch / (36525.0 * 86400.0)
mean_sun = radians(280.46646 + (36000.76983 - PRECESSION) * centuries)  # Meeus 1998, equation 25.2, in GCRS
r, v = perilune.orbit(
    semi_major_axis=a, inclination=acos(-2.0 * pi / YEAR / drift), node=mean_sun + (10.5 - 12.0) * pi / 12.0
)
print(f"epoch = {epoch}")
print(f'"satellite.initial_position" = {r.tolist()}')
print(f'"satellite.initial_velocity" = {v.tolist()}')
