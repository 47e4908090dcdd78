"""Aerodynamic coefficients of a spherical cap in supersonic flow by Newtonian theory, for tables declared by blocks.

The pressure coefficient on the windward side is Cp sin^2 of the local inclination, with Cp at the stagnation point
behind a normal shock (Rayleigh's pitot formula). With the total angle of attack a, k = sin^2 of the cap's half-angle,
and a fully windward cap:

    Cx = Cp (cos^2 a (2 - k)/2 + sin^2 a k/4)        Cy = Cp (k/2) sin a cos a

Source: Anderson 2006, sections 3.2 and 3.3.
"""

import math

from ...kernel.functions import cos, sin

HEAT_RATIO = 1.4


def stagnation_coefficient(mach: float) -> float:
    """Return the pressure coefficient at the stagnation point behind a normal shock, for mach > 1."""
    g, square = HEAT_RATIO, mach * mach
    ratio = ((g + 1.0) ** 2 * square / (4.0 * g * square - 2.0 * (g - 1.0))) ** (g / (g - 1.0))
    return 2.0 / (g * square) * (ratio * (1.0 - g + 2.0 * g * square) / (g + 1.0) - 1.0)


def cap_tables(
    base_radius: float, cap_radius: float, machs: list[float], degrees: list[float]
) -> tuple[list[float], list[float]]:
    """Return tables of Cx and Cy of a cap (radii in m), by row for a Mach number, by column for a total angle of
    attack.

    Angles are in degrees; values are rounded to six decimals, as in the published table.
    """
    k = (base_radius / cap_radius) ** 2
    axial, normal = [], []
    for mach in machs:
        peak = stagnation_coefficient(mach)
        for degree in degrees:
            c, s = cos(math.radians(degree)), sin(math.radians(degree))
            axial.append(round(peak * (c * c * (2.0 - k) / 2.0 + s * s * k / 4.0), 6))
            normal.append(round(peak * k / 2.0 * s * c, 6))
    return axial, normal
