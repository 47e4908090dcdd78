"""Settings of the plant spacecraft that several cases have."""

from collections.abc import Iterable

from crosscheck.space.surroundings import EPOCH, TT_MINUS_UT1

GRAVITY_ALONE = {
    "epoch": EPOCH,
    "tt_minus_ut1": TT_MINUS_UT1,
    "atmosphere": 0,
    "residual_dipole": [0.0, 0.0, 0.0],
}
POINT_MASS = {"gravity_degree": 0, "third_bodies": False}
WITHOUT_WHEELS = {"wheel_inertia": 1e-9, "viscous_friction": 0.0, "coulomb_friction": 0.0}  # the smallest there are
OUTPUTS = {"position": "position", "velocity": "velocity", "quaternion": "quaternion", "rate": "angular_velocity"}


def flat(rows: Iterable[Iterable[float]]) -> list[float]:
    """Return the elements of a matrix by row, as a parameter takes them."""
    return [element for row in rows for element in row]
