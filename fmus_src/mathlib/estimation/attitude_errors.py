"""Error propagation of an attitude integrated from gyros. Kernel functions.

States: small rotation from the estimated to the true attitude in body axes (rad), error of the gyro bias (rad/s).

Source: Lefferts, Markley and Shuster 1982; Crassidis and Junkins 2012, section 7.2.1; Farrenkopf 1978.
"""

import math

from ...kernel.functions import sin
from ...kernel.matrices import Matrix, block, cross_matrix, identity, zeros
from ..attitude.quaternion import from_rotation_vector, to_body
from ..vectors import Vector3, norm, vector
from .kalman import predict

ROTATION = block(0, 3)
BIAS = block(3, 3)
SMALL = 1e-6  # rad, rotation below which the factors of [turn] have their limits for zero rotation


def transition(turn: Vector3, h: float) -> Matrix:
    """Return the transition matrix F (6 x 6) over h (s), during which the body rotates by the vector ``turn`` (rad).

    The rotation error in body axes rotates by -turn; a bias error, times -h (1 - (1 - cos a)/a^2 [turn] + (a - sin
    a)/a^3 [turn]^2) with a = |turn|, is added to it.
    """
    f = identity(6)
    q = from_rotation_vector(turn)
    f[ROTATION, 0] = to_body(q, vector(1.0, 0.0, 0.0))
    f[ROTATION, 1] = to_body(q, vector(0.0, 1.0, 0.0))
    f[ROTATION, 2] = to_body(q, vector(0.0, 0.0, 1.0))
    angle = norm(turn)
    first = 0.5
    second = 1.0 / 6.0
    if angle > SMALL:
        half = sin(0.5 * angle) / angle
        first = 2.0 * half * half
        second = (angle - sin(angle)) / (angle * angle * angle)
    c = cross_matrix(turn)
    f[ROTATION, BIAS] = -h * (identity(3) - first * c + second * c @ c)
    return f


def random_walks(gyro: float, bias: float, h: float) -> Matrix:
    """Return the process noise Q (6 x 6) over h (s) of an angle random walk and a random walk of the bias.

    Their densities are in rad/sqrt(s) and rad/s/sqrt(s).
    """
    q = zeros(6, 6)
    q[ROTATION, ROTATION] = (gyro * gyro * h + bias * bias * h * h * h / 3.0) * identity(3)
    q[ROTATION, BIAS] = -0.5 * bias * bias * h * h * identity(3)
    q[BIAS, ROTATION] = q[ROTATION, BIAS].T
    q[BIAS, BIAS] = bias * bias * h * identity(3)
    return q


def predict_attitude(p: Matrix, turn: Vector3, gyro: float, bias: float, h: float) -> Matrix:
    """Return the covariance (6 x 6) after h (s)."""
    return predict(p, transition(turn, h), random_walks(gyro, bias, h))


def standard_deviations(p: Matrix, k: int) -> Vector3:
    """Return the standard deviations of the states k to k + 2; 0 for a variance that is negative due to rounding."""
    variances = vector(p[k, k], p[k + 1, k + 1], p[k + 2, k + 2])
    deviations = [0.0] * 3
    for i in range(3):
        if variances[i] > 0.0:
            deviations[i] = math.sqrt(variances[i])
    return vector(*deviations)
