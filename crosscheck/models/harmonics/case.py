"""Gravity of the Earth to degree 13 at points outside it, a pole among them."""

from crosscheck.case import vector
from crosscheck.comparison import Comparison
from crosscheck.space.points import points

DEGREE, POINTS = 13, points(50, 6.5e6, 8e6)  # m, planet-fixed
CASE = Comparison(
    title="gravity of degree 13",
    basilisk="`SphericalHarmonicsGravityModel`, by Pines",
    inputs="GGM03S, 50 points from 6.5e6 to 8e6 m, both poles among them",
    quantities={"gravity": vector("gravity")},
    bounds={"gravity": 1e-14},
)
