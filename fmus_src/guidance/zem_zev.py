"""E-guidance, also called ZEM/ZEV, with the time of least propellant."""

from .polynomial_guidance import PolynomialGuidance


class ZemZevGuidance(PolynomialGuidance):
    """Thrust acceleration linear in time, from zero-effort miss and zero-effort velocity error.

        a = (6/T^2) ZEM - (2/T) ZEV

    ZEM and ZEV are the errors of position and velocity that would remain without thrust. For a fixed time to go T the
    law minimises the integral of the squared thrust acceleration.

    Assumes constant gravity unless gravity_correction is set.

    Source: Cherry 1964 (E-guidance); Ebrahimi, Bahrami and Roshanian 2008; Guo, Hawkins and Wie 2011; time of least
    propellant within the thrust limit: this repository.
    """
