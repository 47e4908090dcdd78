"""E-guidance, or ZEM/ZEV, with a time of least propellant."""

from .polynomial_guidance import PolynomialGuidance


class ZemZevGuidance(PolynomialGuidance):
    """Thrust acceleration linear in time: 6/T^2 ZEM - 2/T ZEV.

    ZEM and ZEV are the errors of position and velocity that would be left without thrust. With a fixed time it has the
    least integral of the squared thrust acceleration.
    Source: Cherry 1964 (E-guidance); Ebrahimi, Bahrami and Roshanian 2008; Guo, Hawkins and Wie 2011. The time of least
    propellant within the thrust is ours.
    Assumes constant gravity or gravity_correction.
    """
