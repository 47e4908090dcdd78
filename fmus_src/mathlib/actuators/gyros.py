"""Four single-gimbal gyros in two pairs of parallel gimbal axes (2-SPE), and their steering. Kernel functions.

Momenta are in body axes and in units of the momentum of one rotor. Pair 1 turns about z in the xy plane, pair 2 about
-y in the xz plane; gimbal angles (rad) are measured from x. Three momentum components leave one of the four angles
free. The distribution law u - v + rho (u v - 1) = 0 removes this freedom: u = x1/a and v = x2/b are the momenta of the
two pairs along x, divided by their largest possible values for the present y and z. Under the law each pair biases the
other and stays away from its singular states, in which the magnitude of its momentum is 0 or 2. Derivations:
docs/systems/robot_rendezvous.md.

Source: Somov 2013; Somov, Platonov and Sorokin 2005.
"""

import math

from ...kernel.functions import acos, atan2, cos, sin
from ...kernel.matrices import Matrix, add_product, diagonal, identity, matrix, zeros
from ..vectors import Vector2, Vector3, Vector4, vector

ISOTROPIC_RHO = 0.9797958971132712  # 2 sqrt(6)/5, which makes the three axes equivalent at zero momentum
# acos(1/sqrt(3)) from -x and x: the angles of zero momentum under the law with ISOTROPIC_RHO
ISOTROPIC_ANGLES = (0.6154797086703873, -0.6154797086703873, 3.7570723622601803, 2.5261129449194057)
LEAST_SQUARE = 1e-12  # least square of a and b; below it a pair counts as fully extended across x (y = 2 or z = 2)


def cluster_momentum(angles: Vector4) -> Vector3:
    """Return the momentum of the cluster (body), in units of the momentum of one rotor."""
    first, second, third, fourth = angles
    return vector(
        cos(first) + cos(second) + cos(third) + cos(fourth),
        sin(first) + sin(second),
        sin(third) + sin(fourth),
    )


def cluster_jacobian(angles: Vector4) -> Matrix:
    """Return the 3 x 4 derivative of the momentum with respect to the gimbal angles."""
    first, second, third, fourth = angles
    return matrix(
        [-sin(first), -sin(second), -sin(third), -sin(fourth)],
        [cos(first), cos(second), 0.0, 0.0],
        [0.0, 0.0, cos(third), cos(fourth)],
    )


def nearest_turn(angle: float, reference: float) -> float:
    """Return the angle (rad) shifted by whole revolutions to be nearest to ``reference`` (rad)."""
    turns = (reference - angle) / math.tau
    return angle + math.tau * float(math.floor(turns + 0.5))


def distribute_angles(momentum: Vector3, rho: float, near: Vector4) -> tuple[bool, Vector4]:
    """Return (True, angles (rad)) that give a momentum under the law, or (False, ``near``) without a solution.

    The angles are shifted by whole revolutions to be nearest to ``near`` (rad).
    """
    a_square = 4.0 - momentum.y * momentum.y
    b_square = 4.0 - momentum.z * momentum.z
    if not (a_square > LEAST_SQUARE and b_square > LEAST_SQUARE):
        return False, near
    a = math.sqrt(a_square)
    b = math.sqrt(b_square)
    weight = momentum.x + b * rho
    linear = a + b + rho * momentum.x
    root = linear * linear - 4.0 * a * rho * weight
    if not (root >= 0.0 and linear > 0.0):
        return False, near
    u = 2.0 * weight / (linear + math.sqrt(root))
    if not (abs(u) <= 1.0 and 1.0 - rho * u > 0.0):
        return False, near
    v = (u - rho) / (1.0 - rho * u)
    first, second = pair_angles(u * a, momentum.y, near[0:2])
    third, fourth = pair_angles(v * b, momentum.z, near[2:4])
    return True, vector(first, second, third, fourth)


def pair_angles(along: float, across: float, near: Vector2) -> Vector2:
    """Return the angles (rad) of a pair, nearest to ``near``, for its momentum along x and ``across`` to x."""
    half = 0.5 * math.sqrt(along * along + across * across)
    if half > 1.0:
        half = 1.0  # exceeded by a rounding error
    direction = atan2(across, along)
    opening = acos(half)
    return vector(nearest_turn(direction + opening, near.x), nearest_turn(direction - opening, near.y))


def distribute_rates(
    angles: Vector4, momentum_rate: Vector3, rho: float, gain: float, least: float
) -> tuple[bool, Vector4]:
    """Return (True, gimbal rates (rad/s) under the law) for a momentum_rate (1/s), or (False, 0) near a singular state.

    The residual f of the law decays as f' = -gain f. The first value is False if a divisor is less than ``least``. The
    divisors are the sine of the angle between the rotors of each pair (1 for best steering) and the divisor of the law
    (2 at the isotropic angles).
    """
    first, second, third, fourth = angles
    none = vector(0.0, 0.0, 0.0, 0.0)
    x1 = cos(first) + cos(second)
    x2 = cos(third) + cos(fourth)
    y = sin(first) + sin(second)
    z = sin(third) + sin(fourth)
    a_square = 4.0 - y * y
    b_square = 4.0 - z * z
    if not (a_square > LEAST_SQUARE and b_square > LEAST_SQUARE):
        return False, none
    a = math.sqrt(a_square)
    b = math.sqrt(b_square)
    u = x1 / a
    v = x2 / b
    residual = u - v + rho * (u * v - 1.0)
    p = 1.0 + rho * v
    q = 1.0 - rho * u
    common = a * q + b * p
    sine_1 = sin(second - first)
    sine_2 = sin(fourth - third)
    if not (abs(sine_1) >= least and abs(sine_2) >= least and abs(common) >= least and least > 0.0):
        return False, none
    # change of x1 and x2 beyond the one that y and z cause at constant u and v
    fall_1 = u * y * momentum_rate.y / a
    fall_2 = v * z * momentum_rate.z / b
    u_rate = (q * (momentum_rate.x + fall_1 + fall_2) - b * gain * residual) / common
    x1_rate = a * u_rate - fall_1
    x2_rate = momentum_rate.x - x1_rate
    return True, vector(
        (cos(second) * x1_rate + sin(second) * momentum_rate.y) / sine_1,
        -(cos(first) * x1_rate + sin(first) * momentum_rate.y) / sine_1,
        (cos(fourth) * x2_rate + sin(fourth) * momentum_rate.z) / sine_2,
        -(cos(third) * x2_rate + sin(third) * momentum_rate.z) / sine_2,
    )


def singularity_measure(angles: Vector4) -> float:
    """Return sqrt(det(A A')) of the Jacobian A: 0 in a singular state, 8/sqrt(27) = 1.54 at the isotropic angles."""
    determinant = determinant_of(gram_of(cluster_jacobian(angles), 0.0))
    if not determinant > 0.0:
        return 0.0
    return math.sqrt(determinant)


def rotor_weights(bias: float) -> Vector4:
    """Return 1 + bias for the first rotor of each pair and 1 - bias for the second."""
    return vector(1.0 + bias, 1.0 - bias, 1.0 + bias, 1.0 - bias)


def gram_of(jacobian: Matrix, bias: float) -> Matrix:
    """Return A W A' (3 x 3) of a 3 x 4 matrix A, where W has rotor_weights on its diagonal."""
    return add_product(zeros(3, 3), jacobian @ diagonal(rotor_weights(bias)), jacobian.T)


def determinant_of(m: Matrix) -> float:
    """Return the determinant of a symmetric 3 x 3 matrix from its upper triangle."""
    return (
        m[0, 0] * (m[1, 1] * m[2, 2] - m[1, 2] * m[1, 2])
        - m[0, 1] * (m[0, 1] * m[2, 2] - m[1, 2] * m[0, 2])
        + m[0, 2] * (m[0, 1] * m[1, 2] - m[1, 1] * m[0, 2])
    )


def robust_rates(
    angles: Vector4, momentum_rate: Vector3, damping: float, threshold: float, swing: float, time: float
) -> tuple[Vector4, float]:
    """Return the gimbal rates (rad/s) W A' (A W A' + k E)^-1 momentum_rate and the singularity measure m.

    The rates are bounded everywhere, and exact for k = 0. With lack = 1 - m/threshold, k is damping lack^2 for m below
    the threshold and 0 above (Nakamura and Hanafusa 1986). E and W differ from identity matrices by terms that lead out
    of states in which the required torque cannot be produced (Wie 2005). The off-diagonal elements of E are swing
    sin(pi/2 time + phase), which makes the gimbals oscillate; the diagonal of W is 1 + swing lack for the first rotor
    of each pair and 1 - swing lack for the second, which separates rotors that point the same way. A swing below 0.5
    keeps both matrices positive definite.
    """
    jacobian = cluster_jacobian(angles)
    measure = singularity_measure(angles)
    bias = 0.0
    k = 0.0
    if measure < threshold:
        lack = 1.0 - measure / threshold
        bias = swing * lack
        k = damping * lack * lack
    gram = gram_of(jacobian, bias)
    if k > 0.0:
        gram = gram + k * identity(3)
        gram[1, 2] += k * swing * sin(0.5 * math.pi * time)
        gram[0, 2] += k * swing * sin(0.5 * math.pi * (time + 1.0))
        gram[0, 1] += k * swing * sin(0.5 * math.pi * (time + 2.0))
    determinant = determinant_of(gram)
    if not determinant > 0.0:
        return vector(0.0, 0.0, 0.0, 0.0), measure
    c23 = gram[0, 2] * gram[0, 1] - gram[0, 0] * gram[1, 2]
    c13 = gram[0, 1] * gram[1, 2] - gram[1, 1] * gram[0, 2]
    c12 = gram[1, 2] * gram[0, 2] - gram[2, 2] * gram[0, 1]
    cofactors = matrix(
        [gram[1, 1] * gram[2, 2] - gram[1, 2] * gram[1, 2], c12, c13],
        [c12, gram[0, 0] * gram[2, 2] - gram[0, 2] * gram[0, 2], c23],
        [c13, c23, gram[0, 0] * gram[1, 1] - gram[0, 1] * gram[0, 1]],
    )
    solution = cofactors @ momentum_rate / determinant
    return rotor_weights(bias) * (jacobian.T @ solution), measure
