"""Ends a flight: by guidance, at the hand-over, or on the ground."""

from ..block import Block, Input, Output, Parameter


class FlightMonitor(Block):
    """Ends a flight when guidance has finished, at the hand-over to a next phase, or at the ground.

    The hand-over is the first communication point with less than handover_speed inside the band of
    altitudes. All outputs stay true once they are.
    Ours: docs/systems/lunar_landing.md.
    """

    handover_speed = Parameter(0.0, unit="m/s", minimum=0.0, description="hand over below it; 0: no hand-over here")
    handover_altitude_low = Parameter(1200.0, unit="m", description="lowest altitude of the hand-over")
    handover_altitude_high = Parameter(1800.0, unit="m", description="highest altitude of the hand-over")
    guidance_finished = Input(False, description="guidance says that the flight is over")
    altitude = Input(1.0, unit="m", description="altitude above the ground")
    speed = Input(0.0, unit="m/s", description="speed")
    finished = Output(False, direct=True, description="the flight is over")
    handed_over = Output(False, direct=True, description="the hand-over was reached")
    ground_contact = Output(False, direct=True, description="the ground was reached")

    def initialize(self) -> None:
        self.judge()

    def judge(self) -> None:
        """Latch what has happened."""
        slow = self.speed < self.handover_speed
        if slow and self.altitude >= self.handover_altitude_low and self.altitude <= self.handover_altitude_high:
            self.handed_over = True
        if self.altitude <= 0.0:
            self.ground_contact = True
        if self.guidance_finished or self.handed_over or self.ground_contact:
            self.finished = True

    def step(self, t: float, h: float) -> None:
        self.judge()
