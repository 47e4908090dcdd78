"""The dipole of the Earth's magnetic field at points outside it, both poles among them."""

from crosscheck.case import vector
from crosscheck.comparison import Comparison
from crosscheck.space.points import points

POINTS = points(40, 6.6e6, 8e6)  # m, planet-fixed
CASE = Comparison(
    title="magnetic field of degree 1",
    basilisk="`MagneticFieldCenteredDipole`",
    inputs="IGRF-14 at 2025.0, 40 points from 6.6e6 to 8e6 m, both poles among them",
    quantities={"field": vector("field")},
    bounds={"field": 1e-14},
)
