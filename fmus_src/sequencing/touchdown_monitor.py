"""Monitor of the motion at ground contact."""

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import landing
from ..mathlib.vectors import norm
from ..units import deg


class TouchdownMonitor(Block):
    """Speeds, tilt, angular rate and distance from the site at the first ground contact, with their limits.

    From contact on, all outputs are constant; before contact within_limits is false.

    Frame: landing site.

    See docs/systems/landing_mission.md.
    """

    vertical_speed_limit = Parameter(
        3.0, unit="m/s", minimum=0.0, description="largest allowed vertical speed at ground contact"
    )
    horizontal_speed_limit = Parameter(
        1.0, unit="m/s", minimum=0.0, description="largest allowed horizontal speed at ground contact"
    )
    tilt_limit = Parameter(deg(5.0), unit="rad", minimum=0.0, description="largest allowed tilt at ground contact")
    rate_limit = Parameter(
        deg(2.0), unit="rad/s", minimum=0.0, description="largest allowed angular rate at ground contact"
    )
    distance_limit = Parameter(
        10.0, unit="m", minimum=0.0, description="largest allowed distance from the landing site at ground contact"
    )
    ground_contact = landing.GROUND_CONTACT.input()
    vertical_speed = landing.VERTICAL_SPEED.input(
        "true component of the lander's velocity along the local vertical, positive upwards"
    )
    horizontal_speed = landing.HORIZONTAL_SPEED.input("true speed of the lander perpendicular to the local vertical")
    tilt = landing.TILT.input("true tilt: angle between thrust axis and local vertical")
    angular_rate = landing.ANGULAR_RATE.input("true angular rate of the thrust axis")
    position = landing.POSITION.input("true position of the lander relative to the landing site")
    site = landing.POSITION.input("position of the landing site")
    contact = Output(False, direct=True, description="true: ground contact has occurred, outputs held")
    contact_time = Output(-1.0, unit="s", direct=True, description="time of the ground contact; -1: no contact yet")
    contact_vertical_speed = Output(
        0.0, unit="m/s", direct=True, description="vertical speed at ground contact, positive downwards"
    )
    contact_horizontal_speed = Output(0.0, unit="m/s", direct=True, description="horizontal speed at ground contact")
    contact_tilt = Output(
        0.0, unit="rad", direct=True, description="angle between thrust axis and local vertical at ground contact"
    )
    contact_rate = Output(
        0.0, unit="rad/s", direct=True, description="angular rate of the thrust axis at ground contact"
    )
    contact_distance = Output(
        0.0, unit="m", direct=True, description="distance from the landing site at ground contact"
    )
    within_limits = Output(False, direct=True, description="true: ground contact within all limits")
    start_time = State(0.0, unit="s", description="start time of the simulation")

    def initialize(self) -> None:
        self.watch(self.start_time)

    def watch(self, time: float) -> None:
        """Record the motion at ``time`` (s) at the first ground contact."""
        if self.ground_contact and not self.contact:
            self.contact = True
            self.contact_time = time
            self.contact_vertical_speed = -self.vertical_speed
            self.contact_horizontal_speed = self.horizontal_speed
            self.contact_tilt = self.tilt
            self.contact_rate = norm(self.angular_rate)
            self.contact_distance = norm(self.position - self.site)
            slow = self.contact_vertical_speed <= self.vertical_speed_limit
            slow = slow and self.contact_horizontal_speed <= self.horizontal_speed_limit
            upright = self.contact_tilt <= self.tilt_limit and self.contact_rate <= self.rate_limit
            self.within_limits = slow and upright and self.contact_distance <= self.distance_limit

    def step(self, t: float, h: float) -> None:
        self.watch(t + h)
