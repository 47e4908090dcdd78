"""Orbital attitude in three stages without an observer, the conventional procedure."""

import math

from ..block import Parameter, State
from ..kernel.enumerations import Enumeration, member
from .attitude_observer import AttitudeObserver


class Stage(Enumeration):
    """Stage of the sequence."""

    LEVELLING = member("levelling")
    AVERAGING = member("averaging")
    HOLDING = member("holding")


class OrbitalSequence(AttitudeObserver):
    """Sequence without an observer: levelling with yaw 0, yaw from the mean roll rate, then propagation.

        ψ = (∫ ω_x dt - Δγ)/(ω_0 Δt)

    Until levelling_end the vehicle levels and brings its rotation to rest. Until averaging_end the measured roll rate
    ω_x is integrated; its difference from the change Δγ of roll over the time Δt gives yaw. From then on yaw is
    propagated with the equations of motion, pulse by pulse, without correction. The other angles and the rates are the
    measured ones.

    This conventional procedure is the baseline for the observers. See docs/systems/orbital_attitude.md.
    """

    levelling_end = Parameter(
        90.0, unit="s", minimum=0.0, description="time from the start of the simulation to the end of levelling"
    )
    averaging_end = Parameter(
        270.0, unit="s", minimum=0.0, description="time from the start of the simulation to the end of averaging"
    )
    stage = State(Stage)
    since = State(0, description="number of the sample at which averaging began")
    last_tick = State(0, description="number of the last sample used")
    first_roll = State(0.0, unit="rad", description="measured roll at the start of averaging")
    turned = State(0.0, unit="rad", description="integral of the measured roll rate since the start of averaging")

    def due(self, time: float) -> bool:
        """Return True if the sample nearest to ``time`` (s after the start) has been reached."""
        return self.ticks >= math.floor(time / self.sample_period + 0.5)

    def average(self) -> float:
        """Return the yaw (rad) from the averaging stage; 0 until it ends."""
        elapsed = float(self.ticks - self.last_tick) * self.sample_period
        self.turned = self.turned + 0.5 * elapsed * (self.last_rates.x + self.measured_angular_velocity.x)
        if not self.due(self.averaging_end):
            return 0.0
        self.stage = Stage.HOLDING
        time = float(self.ticks - self.since) * self.sample_period
        return (self.turned - (self.measured_roll - self.first_roll)) / (self.orbital_rate * time)

    def observe(self) -> None:
        yaw = 0.0
        if self.stage == Stage.HOLDING:
            carried = self.propagate_estimate(True)
            yaw = carried.angles.y
        elif self.stage == Stage.AVERAGING:
            yaw = self.average()
        elif self.due(self.levelling_end):
            self.stage = Stage.AVERAGING
            self.since = self.ticks
            self.first_roll = self.measured_roll
        self.last_tick = self.ticks
        self.take_measured(yaw)
