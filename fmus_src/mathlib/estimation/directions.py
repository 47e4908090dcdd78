"""Measured directions in a filter of attitude errors. Kernel functions.

States as in `attitude_errors`: the small rotation is in body axes and multiplies the estimated attitude from the right.

Source: Markley and Crassidis 2014, sections 5.1 and 6.2.
"""

from ...kernel.matrices import Matrix, cross_matrix, inverse_quadratic_form, zeros
from ..attitude.quaternion import to_body
from ..vectors import Vector3, Vector4, norm
from .attitude_errors import ROTATION
from .kalman import update


def sensitivity(predicted: Vector3) -> Matrix:
    """Return the sensitivity H (3 x 6) of a predicted direction b (body): [b x] with respect to the rotation error."""
    h = zeros(3, 6)
    h[0:3, ROTATION] = cross_matrix(predicted)
    return h


def innovation(q: Vector4, reference_inertial: Vector3, measured_body: Vector3) -> Vector3:
    """Return the measured minus the predicted direction, both normalised; neither may be 0."""
    return measured_body / norm(measured_body) - to_body(q, reference_inertial / norm(reference_inertial))


def squared_distance(p: Matrix, h: Matrix, variances: Vector3, z: Vector3) -> float:
    """Return z' (H P H' + R)^-1 z, the normalised innovation squared of three components with independent errors."""
    s = h @ p @ h.T
    e = zeros(3, 1)
    for i in range(3):
        s[i, i] = s[i, i] + variances[i]
        e[i, 0] = z[i]
    return inverse_quadratic_form(s, e)


def update_three(x: Matrix, p: Matrix, h: Matrix, variances: Vector3, z: Vector3) -> tuple[Matrix, Matrix, float]:
    """Return x and P updated by three scalars in turn, and the sum of their normalised innovations squared."""
    y = x.copy()
    corrected = p.copy()
    row = zeros(1, 6)
    total = 0.0
    for k in range(3):
        for j in range(6):
            row[0, j] = h[k, j]
        y, corrected, square = update(y, corrected, row, variances[k], z[k])
        total = total + square
    return y, corrected, total
