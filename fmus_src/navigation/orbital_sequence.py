"""Orbital attitude in three stages, as it is done without an observer."""

import math

from ..block import Parameter, State
from ..kernel.enumerations import Enumeration, member
from .attitude_observer import AttitudeObserver


class Stage(Enumeration):
    """Stage of the vehicle."""

    LEVELLING = member("levelling")
    AVERAGING = member("averaging")
    HOLDING = member("holding")


class OrbitalSequence(AttitudeObserver):
    """Three stages: level with yaw taken as 0, find yaw from the mean roll rate, then carry it on by the motion.

    Until levelling_end the vehicle levels and stops. Until averaging_end the measured roll rate is integrated;
    what roll has not turned of that is w0 yaw times the time. From then on yaw is that of the motion from the last
    estimate, pulse by pulse, with nothing to correct it. Angles and rates are as measured throughout.
    The baseline that observers are compared with; docs/systems/orbital_attitude.md says what is known of the real one.
    """

    levelling_end = Parameter(90.0, unit="s", minimum=0.0, description="end of the first stage after the start")
    averaging_end = Parameter(270.0, unit="s", minimum=0.0, description="end of the second stage after the start")
    stage = State(Stage)
    since = State(0, description="tick at which averaging began")
    last_tick = State(0, description="tick of the last sample")
    first_roll = State(0.0, unit="rad", description="roll when averaging began")
    turned = State(0.0, unit="rad", description="roll rate integrated since then")

    def due(self, time: float) -> bool:
        """Return True if the tick nearest to a time (s after the start) has come."""
        return self.ticks >= math.floor(time / self.sample_period + 0.5)

    def average(self) -> float:
        """Return the yaw (rad) of the second stage, 0 until it ends."""
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
            carried = self.carry(True)
            yaw = carried.angles.y
        elif self.stage == Stage.AVERAGING:
            yaw = self.average()
        elif self.due(self.levelling_end):
            self.stage = Stage.AVERAGING
            self.since = self.ticks
            self.first_roll = self.measured_roll
        self.last_tick = self.ticks
        self.take_measured(yaw)
