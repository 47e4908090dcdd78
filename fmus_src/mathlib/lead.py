"""Lead compensator in discrete time by Tustin's rule, for three axes. Kernel functions.

gain (lead s + 1)/(lag s + 1), sampled with a period T, is g' = decay g + e, m = share g + direct e, and a law
is the vector (decay, share, direct):

    decay = (2 lag - T)/(2 lag + T)    direct = gain (2 lead + T)/(2 lag + T)
    share = gain ((T - 2 lead)/(2 lag + T) + decay (2 lead + T)/(2 lag + T))

Source: Franklin, Powell and Workman 1998, section 6.1.2; derivation in docs/systems/robot_rendezvous.md.
"""

from .vectors import Vector3, vector

NO_STATE = 1e-12  # of the direct part: a share below it cannot carry an output


def tustin_lead(gain: float, lead: float, lag: float, period: float) -> Vector3:
    """The law; times in s, not both lag and period 0."""
    divisor = 2.0 * lag + period
    decay = (2.0 * lag - period) / divisor
    direct = gain * (2.0 * lead + period) / divisor
    return vector(decay, gain * (period - 2.0 * lead) / divisor + decay * direct, direct)


def lead_output(law: Vector3, g: Vector3, e: Vector3) -> Vector3:
    """The output from the state g and the input e."""
    _, fraction, direct = law
    return fraction * g + direct * e


def advance_lead(law: Vector3, g: Vector3, e: Vector3) -> Vector3:
    """The state at the next tick."""
    return law[0] * g + e


def change_lead(old: Vector3, new: Vector3, e: Vector3, g: Vector3) -> Vector3:
    """The state with which the new law puts out for e what the old one did; 0 where the new one has no state."""
    _, old_share, old_direct = old
    _, fraction, direct = new
    if abs(fraction) > NO_STATE * abs(direct):
        return (old_share * g + (old_direct - direct) * e) / fraction
    return vector(0.0, 0.0, 0.0)
