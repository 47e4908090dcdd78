"""Jet pulses for a demanded torque, with the remainder carried over."""

import math

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import clip, is_finite, vector


class PulseStatus(Enumeration):
    """Status of the last demand."""

    GOOD = member("good")
    SATURATED = member("demand beyond the sample period")
    NOT_FINITE = member("demand not finite")


class PulseAllocation(Block):
    """Pulses about three axes that give the commanded angular impulse, with a carried remainder.

    With the remainder r (s) per axis, torque level M, sample period T and pulse length τ:

        r = r + u T/M    τ = min(|r|, T)    r = r - τ sgn(r)

    τ is 0 if it would be shorter than shortest_pulse, and r is 0 after τ = T. Otherwise the remainder stays below
    shortest_pulse; the impulse fired since the start then differs from the demand by less than shortest_pulse at the
    torque level, and the impulse of any interval by less than twice as much. At a sample without demand r is multiplied
    by rest_kept. With mean, which serves linear studies, the demand is output as a torque over the sample period,
    limited to the level, and no jet fires. A demand that is not finite fires nothing.

    Frame: body.

    Assumes jets without rise time.

    See docs/systems/orbital_attitude.md.
    """

    default_step = 0.2

    jet_torque = body.JET_TORQUE.parameter()
    shortest_pulse = body.SHORTEST_PULSE.parameter()
    rest_kept = Parameter(
        1.0,
        unit="1",
        minimum=0.0,
        maximum=1.0,
        description="fraction of the unfired impulse retained at a sample without demand",
    )
    mean = Parameter(False, description="true: mean torque over a sample period applied in place of pulses")
    sample_period = sampling.SAMPLE_PERIOD.parameter(description="sample period of the pulse allocation", minimum=1e-3)
    torque_command = body.TORQUE.input("commanded torque of the jets, mean over the sample period")
    pulse_lengths = body.PULSES.output(direct=True)
    pulse_count = body.PULSE_COUNT.output()
    mean_torque = body.TORQUE.output("mean torque applied in place of pulses", direct=True)
    remainder = body.PULSES.output(
        "demanded but unfired impulse, as signed pulse lengths about x, y and z", direct=True
    )
    status = Output(PulseStatus, direct=True)
    lengths = State(
        [0.0] * 3,
        vector=False,
        unit="s",
        description="pulse lengths of the current sample about the body axes x, y and z, signed as the torque",
    )
    rests = State(
        [0.0] * 3,
        vector=False,
        unit="s",
        description="demanded but unfired pulse lengths about the body axes x, y and z, signed as the torque",
    )

    def initialize(self) -> None:
        self.allocate()

    def pulse(self, k: int) -> None:
        """Set pulse length and remainder of axis k."""
        self.rests[k] = self.rests[k] + self.torque_command[k] * self.sample_period / self.jet_torque[k]
        length = abs(self.rests[k])
        if length >= self.sample_period:
            length = self.sample_period
            self.status = PulseStatus.SATURATED
        if length >= self.shortest_pulse and length > 0.0:
            self.lengths[k] = math.copysign(length, self.rests[k])
            self.rests[k] = self.rests[k] - self.lengths[k]
        if length == self.sample_period:
            self.rests[k] = 0.0
        if self.torque_command[k] == 0.0:
            self.rests[k] = self.rest_kept * self.rests[k]

    def within_level(self, k: int) -> float:
        """Return the demand about axis k, limited to the torque of the axis's jet (N m)."""
        if abs(self.torque_command[k]) > self.jet_torque[k]:
            self.status = PulseStatus.SATURATED
        return clip(self.torque_command[k], -self.jet_torque[k], self.jet_torque[k])

    def pass_mean(self) -> None:
        """Set the mean torque to the demand limited to the torque levels."""
        x = self.within_level(0)
        y = self.within_level(1)
        z = self.within_level(2)
        self.mean_torque = vector(x, y, z)

    def allocate(self) -> None:
        """Set the pulses for the demand of this sample."""
        self.pulse_count = self.pulse_count + 1
        self.status = PulseStatus.GOOD
        for k in range(3):
            self.lengths[k] = 0.0
        self.mean_torque = vector(0.0, 0.0, 0.0)
        if not is_finite(self.torque_command):
            self.status = PulseStatus.NOT_FINITE
        elif self.mean:
            self.pass_mean()
        else:
            for k in range(3):
                self.pulse(k)
        self.pulse_lengths = vector(*self.lengths)
        self.remainder = vector(*self.rests)

    def step(self, t: float, h: float) -> None:
        self.allocate()
