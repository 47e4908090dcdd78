"""Lead compensator for three axes, discretised by Tustin's rule. Kernel functions.

gain (lead s + 1)/(lag s + 1), sampled with period T, becomes g' = decay g + e, m = state_gain g + input_gain e:

    decay = (2 lag - T)/(2 lag + T)    input_gain = gain (2 lead + T)/(2 lag + T)
    state_gain = gain ((T - 2 lead)/(2 lag + T) + decay (2 lead + T)/(2 lag + T))

Source: Franklin, Powell and Workman 1998, section 6.1.2; derivation in docs/systems/robot_rendezvous.md.
"""

from ..kernel.records import Field, Record
from .vectors import Vector3, vector

NO_STATE = 1e-12  # fraction of the input gain; a smaller state gain has no effect on the output


class LeadLaw(Record):
    """Coefficients of a discrete-time lead compensator."""

    decay = Field(unit="1", description="factor of the state from one sample to the next")
    state_gain = Field(description="gain from the state to the output")
    input_gain = Field(description="gain from the input to the output")


def tustin_lead(gain: float, lead: float, lag: float, period: float) -> LeadLaw:
    """Return the compensator for lead and lag times and a period in s; lag and period must not both be 0."""
    divisor = 2.0 * lag + period
    decay = (2.0 * lag - period) / divisor
    input_gain = gain * (2.0 * lead + period) / divisor
    return LeadLaw(
        decay=decay, state_gain=gain * (period - 2.0 * lead) / divisor + decay * input_gain, input_gain=input_gain
    )


def lead_output(law: LeadLaw, g: Vector3, e: Vector3) -> Vector3:
    """Return the output for state g and input e."""
    return law.state_gain * g + law.input_gain * e


def advance_lead(law: LeadLaw, g: Vector3, e: Vector3) -> Vector3:
    """Return the state at the next sample."""
    return law.decay * g + e


def is_same(one: LeadLaw, other: LeadLaw) -> bool:
    """Return True if two compensators have equal coefficients."""
    return one.decay == other.decay and one.state_gain == other.state_gain and one.input_gain == other.input_gain


def change_lead(old: LeadLaw, new: LeadLaw, e: Vector3, g: Vector3) -> Vector3:
    """Return the state for which the new compensator has the output of the old one at input e.

    The state is 0 if the output of the new compensator does not depend on it.
    """
    if abs(new.state_gain) > NO_STATE * abs(new.input_gain):
        return (old.state_gain * g + (old.input_gain - new.input_gain) * e) / new.state_gain
    return vector(0.0, 0.0, 0.0)
