"""Interface of controllers of an entry capsule, which compute the torque over a sample period from bank and rates."""

import math

from ..block import Block, Inputs, Output, Parameter
from ..interfaces.ports import body, entry, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import Vector3, clip, is_finite, vector
from ..units import deg


class EntryControlStatus(Enumeration):
    """Status of the torque command."""

    GOOD = member("good")
    NOT_FINITE = member("inputs not finite")


class EntryControl(Block, interface=True):
    """Torque that holds a capsule at trim and at the programmed bank angle, from bank and rates alone.

    Angle of attack, sideslip, speed and pressure are not measured; dynamic_pressure serves gain scheduling. At trim,
    with trim_attack α_0 and bank rate γ', the capsule rotates about its velocity at

        ω = γ' (cos α_0, -sin α_0, 0)

    Demands below dead_zone times the torque level are set to 0, and inputs that are not finite give no torque. A
    controller defines `regulate`, which returns the demanded torque.

    Frame: body.

    Assumes a capsule near its trim and a known inertia.

    Source: Lapin, thesis, chapter 3.2. See docs/systems/entry_attitude.md.
    """

    to_write = ("regulate",)

    default_step = 0.2

    inertia = body.INERTIA.parameter(description="inertia matrix of the capsule, as known on board")
    jet_torque = body.JET_TORQUE.parameter(
        [100.0, 80.0, 80.0], "torque of one jet about x, y and z, as known on board, equal for both signs"
    )
    trim_attack = Parameter(deg(-20.0), unit="rad", description="trim angle of attack of the capsule")
    dead_zone = Parameter(
        0.0, unit="1", minimum=0.0, description="largest torque demand that is ignored, as a fraction of a jet's torque"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(description="sample period of the control", minimum=1e-3)
    measured_bank = entry.BANK.input("measured bank angle of the capsule")
    measured_angular_velocity = body.ANGULAR_VELOCITY.input(
        "measured angular velocity of the capsule relative to the inertial frame"
    )
    target_bank = entry.TARGET_BANK.input("target bank angle of the programme", start=0.0)
    reference = Inputs(entry.BankReference, prefix="reference_", bank=0.0)
    error_limit = entry.ERROR_LIMIT.input("magnitude to which the bank error is limited")
    dynamic_pressure = entry.DYNAMIC_PRESSURE.input("dynamic pressure by which gains are scheduled", start=1000.0)
    torque_command = body.TORQUE.output("commanded torque of the jets, mean over the sample period", direct=True)
    status = Output(EntryControlStatus, direct=True)

    def regulate(self) -> Vector3:
        """Return the demanded torque (N m, body) for the present inputs."""
        return vector(0.0, 0.0, 0.0)

    def wrap_angle(self, angle: float) -> float:
        """Return an angle (rad) wrapped to +-pi."""
        return angle - 2.0 * math.pi * float(math.floor(angle / (2.0 * math.pi) + 0.5))

    def bank_error(self) -> float:
        """Return measured minus reference bank angle (rad), limited to error_limit."""
        return clip(self.wrap_angle(self.measured_bank - self.reference.bank), -self.error_limit, self.error_limit)

    def apply_dead_zone(self, demand: float, level: float) -> float:
        """Return a torque demand (N m), or 0 if it lies within the dead zone, a fraction of the torque level (N m)."""
        if abs(demand) < self.dead_zone * level:
            return 0.0
        return demand

    def command(self) -> None:
        """Set torque_command and status."""
        bank = math.isfinite(self.measured_bank) and math.isfinite(self.reference.bank)
        lead = math.isfinite(self.reference.bank_rate) and math.isfinite(self.reference.bank_acceleration)
        reported = math.isfinite(self.dynamic_pressure) and math.isfinite(self.error_limit)
        if not (bank and lead and reported and is_finite(self.measured_angular_velocity)):
            self.status = EntryControlStatus.NOT_FINITE
            self.torque_command = vector(0.0, 0.0, 0.0)
            return
        self.status = EntryControlStatus.GOOD
        demand = self.regulate()
        x = self.apply_dead_zone(demand.x, self.jet_torque.x)
        y = self.apply_dead_zone(demand.y, self.jet_torque.y)
        z = self.apply_dead_zone(demand.z, self.jet_torque.z)
        self.torque_command = vector(x, y, z)

    def initialize(self) -> None:
        self.command()

    def step(self, t: float, h: float) -> None:
        self.command()
