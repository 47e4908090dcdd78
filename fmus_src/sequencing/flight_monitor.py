"""Ends a flight: by guidance, at the hand-over, or on the ground."""

from ..block import Block, Input, Output
from ..interfaces.ports import landing


class FlightMonitor(Block):
    """Ends a flight when guidance has finished, at the hand-over to a next phase, or at the ground.

    The hand-over is the first communication point with less than handover_speed inside the band of
    altitudes. All outputs stay true once they are.
    Ours: docs/systems/lunar_landing.md.
    """

    handover_speed = landing.HANDOVER_SPEED.parameter(0.0, "hand over below it; 0: no hand-over here")
    handover_altitude_low = landing.HANDOVER_ALTITUDE_LOW.parameter(description="lowest altitude of the hand-over")
    handover_altitude_high = landing.HANDOVER_ALTITUDE_HIGH.parameter(description="highest altitude of the hand-over")
    guidance_finished = Input(False, description="guidance says that the flight is over")
    altitude = landing.ALTITUDE.input("altitude above the ground", start=1.0)
    speed = Input(0.0, unit="m/s", description="speed")
    finished = landing.FINISHED.output(direct=True)
    handed_over = Output(False, direct=True, description="the hand-over was reached")
    ground_contact = landing.GROUND_CONTACT.output(direct=True)

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
