"""Passes on the command of the guidance that is in charge."""

from ..block import Block, Input
from ..interfaces.ports import landing
from ..interfaces.ports.landing import CommandSource
from ..mathlib.vectors import vector


class CommandSwitch(Block):
    """The command of one of three sources, without thrust unless the engine is on.

    `source` 1 is the sequencer's own command, 2 the braking guidance's, 3 the hover guidance's, and only its
    angular_acceleration_feed is passed on. Where the hover guidance takes over, the last command is held until
    hover_plan, the plan that its command belongs to, is the requested plan_number. Without a source there is no thrust,
    and a direction of length 0, at which the attitude control only brings the rate to rest. Frame: landing site.
    Ours: docs/systems/landing_mission.md.
    """

    source = Input(CommandSource)
    engine_on = landing.ENGINE_ON.input()
    plan_number = landing.PLAN_NUMBER.input("of the plan requested from the hover guidance")
    hover_plan = landing.HOVER_PLAN.input()
    own_thrust_acceleration = Input(0.0, unit="m/s2", description="the sequencer's own command: thrust over mass")
    own_thrust_direction = landing.DIRECTION.input(
        "the sequencer's own command: unit vector at its time", start=[0.0, 0.0, 0.0]
    )
    own_thrust_direction_rate = landing.DIRECTION_RATE.input("the sequencer's own command: the derivative")
    own_command_time = Input(0.0, unit="s", description="the sequencer's own command: when it was computed")
    own_burn_duration = Input(0.0, unit="s", description="the sequencer's own command: how long to thrust from then on")
    braking_thrust_acceleration = Input(0.0, unit="m/s2", description="the braking guidance: thrust over mass")
    braking_thrust_direction = landing.DIRECTION.input(
        "the braking guidance: unit vector at its time", start=[0.0, 0.0, 0.0]
    )
    braking_thrust_direction_rate = landing.DIRECTION_RATE.input("the braking guidance: the derivative")
    braking_command_time = Input(0.0, unit="s", description="the braking guidance: when it was computed")
    braking_burn_duration = Input(0.0, unit="s", description="the braking guidance: how long to thrust from then on")
    hover_thrust_acceleration = Input(0.0, unit="m/s2", description="the hover guidance: thrust over mass")
    hover_thrust_direction = landing.DIRECTION.input(
        "the hover guidance: unit vector at its time", start=[0.0, 0.0, 0.0]
    )
    hover_thrust_direction_rate = landing.DIRECTION_RATE.input("the hover guidance: the derivative")
    hover_command_time = Input(0.0, unit="s", description="the hover guidance: when it was computed")
    hover_burn_duration = Input(0.0, unit="s", description="the hover guidance: how long to thrust from then on")
    hover_angular_acceleration_feed = landing.ANGULAR_ACCELERATION.input("the hover guidance: of its plan")
    thrust_acceleration = landing.THRUST_ACCELERATION.output("thrust over mass", direct=True)
    thrust_direction = landing.DIRECTION.output(
        "unit vector at command_time; 0: none", start=[0.0, 0.0, 0.0], direct=True
    )
    thrust_direction_rate = landing.DIRECTION_RATE.output(direct=True)
    command_time = landing.COMMAND_TIME.output(direct=True)
    burn_duration = landing.BURN_DURATION.output(direct=True)
    angular_acceleration_feed = landing.ANGULAR_ACCELERATION.output("that the command itself needs", direct=True)

    def initialize(self) -> None:
        self.switch()

    def switch(self) -> None:
        """Pass on the command in charge; until the requested plan is answered, the outputs stay."""
        if self.source != CommandSource.HOVER or self.hover_plan == self.plan_number:
            self.pass_on()
        if not self.engine_on or self.source < CommandSource.OWN or self.source > CommandSource.HOVER:
            self.thrust_acceleration = 0.0

    def pass_on(self) -> None:
        """Put the command of the source on the outputs."""
        self.angular_acceleration_feed = vector(0.0, 0.0, 0.0)
        if self.source == CommandSource.OWN:
            self.thrust_acceleration = self.own_thrust_acceleration
            self.thrust_direction = self.own_thrust_direction
            self.thrust_direction_rate = self.own_thrust_direction_rate
            self.command_time = self.own_command_time
            self.burn_duration = self.own_burn_duration
        elif self.source == CommandSource.BRAKING:
            self.thrust_acceleration = self.braking_thrust_acceleration
            self.thrust_direction = self.braking_thrust_direction
            self.thrust_direction_rate = self.braking_thrust_direction_rate
            self.command_time = self.braking_command_time
            self.burn_duration = self.braking_burn_duration
        elif self.source == CommandSource.HOVER:
            self.thrust_acceleration = self.hover_thrust_acceleration
            self.thrust_direction = self.hover_thrust_direction
            self.thrust_direction_rate = self.hover_thrust_direction_rate
            self.command_time = self.hover_command_time
            self.burn_duration = self.hover_burn_duration
            self.angular_acceleration_feed = self.hover_angular_acceleration_feed
        else:
            self.thrust_direction = vector(0.0, 0.0, 0.0)
            self.thrust_direction_rate = vector(0.0, 0.0, 0.0)

    def step(self, t: float, h: float) -> None:
        self.switch()
