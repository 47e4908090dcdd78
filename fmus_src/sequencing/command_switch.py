"""Switch between the commands of several sources."""

from ..block import Block, Input, Inputs, Outputs, State
from ..interfaces.ports import landing
from ..interfaces.ports.landing import CommandSource, ThrustCommand
from ..mathlib.vectors import vector


class CommandSwitch(Block):
    """Selection of one of three command sources, without thrust unless the engine is on.

    `source` 1 is the sequencer, 2 the braking guidance, 3 the hover guidance; only the hover guidance has an
    angular_acceleration_feed. After a change to the hover guidance the last command is held until hover_plan, the
    number of the plan to which the command belongs, equals plan_number. Without a source the output is zero thrust and
    a direction of length 0, for which attitude control brings the rate to 0.

    Frame: landing site.

    See docs/systems/landing_mission.md.
    """

    source = Input(CommandSource)
    engine_on = landing.ENGINE_ON.input("true: engine to burn")
    plan_number = landing.PLAN_NUMBER.input("number of the plan requested from the hover guidance")
    hover_plan = landing.HOVER_PLAN.input()
    sequencer = Inputs(ThrustCommand, prefix="own_", about="command of the sequencer:")
    braking = Inputs(ThrustCommand, prefix="braking_", about="command of the braking guidance:")
    hover = Inputs(ThrustCommand, prefix="hover_", about="command of the hover guidance:")
    hover_angular_acceleration_feed = landing.ANGULAR_ACCELERATION.input(
        "feedforward of the thrust axis' angular acceleration, from the hover guidance"
    )
    command = Outputs(ThrustCommand, direct=True)
    angular_acceleration_feed = landing.ANGULAR_ACCELERATION.output(
        "feedforward of the thrust axis' angular acceleration", direct=True
    )
    passed_thrust_acceleration = State(
        0.0,
        unit="m/s2",
        description="thrust acceleration of the last command passed on, whether the engine is on or off",
    )

    def initialize(self) -> None:
        self.switch()

    def switch(self) -> None:
        """Output the command of the source; after a plan request hold the last command until a plan answers it."""
        if self.source != CommandSource.HOVER or self.hover_plan == self.plan_number:
            self.copy_command()
        self.command.thrust_acceleration = 0.0
        if self.engine_on:
            self.command.thrust_acceleration = self.passed_thrust_acceleration

    def copy_command(self) -> None:
        """Copy the command of the source to the outputs."""
        self.angular_acceleration_feed = vector(0.0, 0.0, 0.0)
        if self.source == CommandSource.OWN:
            self.command = self.sequencer
        elif self.source == CommandSource.BRAKING:
            self.command = self.braking
        elif self.source == CommandSource.HOVER:
            self.command = self.hover
            self.angular_acceleration_feed = self.hover_angular_acceleration_feed
        else:
            self.command.thrust_acceleration = 0.0
            self.command.thrust_direction = vector(0.0, 0.0, 0.0)
            self.command.thrust_direction_rate = vector(0.0, 0.0, 0.0)
        self.passed_thrust_acceleration = self.command.thrust_acceleration

    def step(self, t: float, h: float) -> None:
        self.switch()
