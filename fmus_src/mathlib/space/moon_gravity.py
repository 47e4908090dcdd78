"""Gravity of the Moon to degree 8: LP165P. Kernel functions.

It serves attitude and short arcs: the mass concentrations that rule a low lunar orbit need a much higher degree.
Source: Konopliv et al. 2001, fully normalised coefficients in principal axes, which are within about 0.03 deg of the
mean-Earth axes of `orientation`.
"""

from ...kernel.matrices import Matrix, zeros
from .harmonics import SIZE, full_normalisation, set_pair

GRAVITATIONAL_PARAMETER = 4.902801056e12  # m3/s2
RADIUS = 1738000.0  # m
DEGREE = 8

# C, S of orders 0 to n, for each degree n from 2 on.
NORMALISED = (
    -9.08901807506e-05, 0.0, -2.72203236159e-09, -7.57518292083e-10, 3.46354993722e-05, 1.67294905383e-08,
    -3.2035914003e-06, 0.0, 2.63274401218e-05, 5.46436308982e-06, 1.41881793294e-05, 4.89203650048e-06,
    1.22860589447e-05, -1.78544808164e-06,
    3.19730957172e-06, 0.0, -5.99660183015e-06, 1.66193451947e-06, -7.08180692697e-06, -6.78362717269e-06,
    -1.36229833813e-06, -1.34434722871e-05, -6.02577873583e-06, 3.93963719538e-06,
    -2.15703820682e-07, 0.0, -1.01919565376e-06, -4.10925415073e-06, 4.37660811497e-06, 1.08409976988e-06,
    4.49776787595e-07, 8.70084120862e-06, 2.78342413603e-06, 5.9388023933e-08, 3.11962589377e-06,
    -2.76096627196e-06,
    3.76578061866e-06, 0.0, 1.53198439389e-06, -2.57660063976e-06, -4.35221812323e-06, -2.18744801522e-06,
    -3.2700516346e-06, -3.46914302843e-06, 3.69782185786e-07, -4.0688106563e-06, 1.40447461835e-06,
    -1.03317018897e-05, -4.70430108546e-06, 7.23600881351e-06,
    5.62221178728e-06, 0.0, 7.55225923445e-06, -1.29652220233e-07, -6.6319483616e-07, 2.38478906716e-06,
    5.82678799477e-07, 2.3557722607e-06, -9.2662653013e-07, 7.91573654661e-07, -2.7194779737e-07,
    1.12687787884e-06, -9.92885724133999e-07, 1.10795486684e-06, -1.78846608865e-06, -1.61650710716e-06,
    2.34649968012e-06, 0.0, -6.08898121792e-08, 1.11254486148e-06, 2.99477787799e-06, 1.92583247584e-06,
    -1.88001218115e-06, 9.5358255051e-07, 3.37351972159e-06, -4.56056539569e-07, -1.12527271732e-06,
    2.92571495319e-06, -1.54330144128e-06, -2.24818427111e-06, -1.59146518001e-06, 3.22209097255e-06,
    -2.53069725912e-06, 2.14062002356e-06,
)  # fmt: skip


def moon_gravity() -> Matrix:
    """Return the coefficients for `harmonics.gradient`, unnormalised."""
    cs = zeros(SIZE, SIZE)
    cs[0, 0] = 1.0
    k = 0
    for n in range(2, DEGREE + 1):
        for m in range(n + 1):
            factor = full_normalisation(n, m)
            set_pair(cs, n, m, factor * NORMALISED[k], factor * NORMALISED[k + 1])
            k = k + 2
    return cs
