"""Monitor that ends a flight: by guidance, at the hand-over, or on the ground."""

from ..block import Block, Input, Output
from ..interfaces.ports import landing


class FlightMonitor(Block):
    """End of a flight by guidance, by hand-over to the next phase, or at the ground.

    The hand-over is the first communication point below handover_speed within the altitude limits. All outputs are
    latched.

    See docs/systems/lunar_landing.md.
    """

    handover_speed = landing.HANDOVER_SPEED.parameter(
        0.0, "speed below which the vehicle is handed over to the next phase; 0: no hand-over"
    )
    handover_altitude_low = landing.HANDOVER_ALTITUDE_LOW.parameter(
        description="lowest altitude at which the vehicle is handed over to the next phase"
    )
    handover_altitude_high = landing.HANDOVER_ALTITUDE_HIGH.parameter(
        description="highest altitude at which the vehicle is handed over to the next phase"
    )
    guidance_finished = Input(False, description="true: guidance finished")
    altitude = landing.ALTITUDE.input("altitude of the vehicle above the ground", start=1.0)
    speed = Input(0.0, unit="m/s", description="speed of the vehicle")
    finished = landing.FINISHED.output(direct=True)
    handed_over = Output(False, direct=True, description="true: conditions of the hand-over met")
    ground_contact = landing.GROUND_CONTACT.output(direct=True)

    def initialize(self) -> None:
        self.latch_conditions()

    def latch_conditions(self) -> None:
        """Latch the conditions that hold."""
        slow = self.speed < self.handover_speed
        if slow and self.altitude >= self.handover_altitude_low and self.altitude <= self.handover_altitude_high:
            self.handed_over = True
        if self.altitude <= 0.0:
            self.ground_contact = True
        if self.guidance_finished or self.handed_over or self.ground_contact:
            self.finished = True

    def step(self, t: float, h: float) -> None:
        self.latch_conditions()
