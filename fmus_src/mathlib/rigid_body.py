"""Rotation of a rigid body that carries gyros, in principal body axes. Kernel functions.

J w' + w x (J w + H) = M - H' with the angular momentum H of the gyros and the torque M of everything else.
"""


def total_momentum(inertia: list, rate: list, gyros: list, total: list) -> None:
    """total = J w + H (N m s) of body and gyros."""
    for i in range(3):
        total[i] = inertia[i] * rate[i] + gyros[i]
