"""The slot of regulators of an entry capsule: from measured bank and rates to the torque over a tick."""

import math

from ..block import Block, Inputs, Output, Parameter
from ..interfaces.ports import body, entry, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import Vector3, clip, is_finite, vector
from ..units import deg


class EntryControlStatus(Enumeration):
    """Presence of a demand."""

    GOOD = member("good")
    NOT_FINITE = member("inputs not finite")


class EntryControl(Block, interface=True):
    """Torque that holds the capsule at its trim and at the bank of a programme, from bank and rates alone.

    Attack, sideslip, speed and pressure are not measured; dynamic_pressure is for regulators that are told. At trim
    the capsule turns about its velocity by w = rate (cos a0, -sin a0, 0), a0 = trim_attack. Demands below dead_zone of
    a level are put out as 0. A regulator writes `regulate`, which sets demand. Inputs that are not finite ask for no
    torque. Frame: body. Equations: docs/systems/entry_attitude.md. Source: Lapin, thesis, chapter 3.2.
    Assumes a capsule near its trim, and inertia as known on board.
    """

    to_write = ("regulate",)

    default_step = 0.2

    inertia = body.INERTIA.parameter(description="matrix of inertia, as known on board")
    jet_torque = body.JET_TORQUE.parameter([100.0, 80.0, 80.0], "levels as known on board, both ways")
    trim_attack = Parameter(deg(-20.0), unit="rad", description="attack at which the capsule trims")
    dead_zone = Parameter(0.0, unit="1", minimum=0.0, description="share of a level below which nothing is demanded")
    sample_period = sampling.SAMPLE_PERIOD.parameter(description="tick", minimum=1e-3)
    measured_bank = entry.BANK.input()
    measured_angular_velocity = body.ANGULAR_VELOCITY.input()
    target_bank = entry.TARGET_BANK.input("target of the programme", start=0.0)
    reference = Inputs(entry.BankReference, prefix="reference_", bank=0.0)
    error_limit = entry.ERROR_LIMIT.input("largest error of bank to act on")
    dynamic_pressure = entry.DYNAMIC_PRESSURE.input("for regulators that are told", start=1000.0)
    torque_command = body.TORQUE.output("torque wanted over the tick", direct=True)
    status = Output(EntryControlStatus, direct=True)

    def regulate(self) -> Vector3:
        """Return the torque (N m, body) for the present inputs."""
        return vector(0.0, 0.0, 0.0)

    def wrap_angle(self, angle: float) -> float:
        """Return an angle (rad) within +-pi."""
        return angle - 2.0 * math.pi * float(math.floor(angle / (2.0 * math.pi) + 0.5))

    def bank_error(self) -> float:
        """Return measured bank less the reference (rad), within error_limit."""
        return clip(self.wrap_angle(self.measured_bank - self.reference.bank), -self.error_limit, self.error_limit)

    def beyond(self, demand: float, level: float) -> float:
        """Return a demand, 0 within the dead zone of a level (N m)."""
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
        x = self.beyond(demand.x, self.jet_torque.x)
        y = self.beyond(demand.y, self.jet_torque.y)
        z = self.beyond(demand.z, self.jet_torque.z)
        self.torque_command = vector(x, y, z)

    def initialize(self) -> None:
        self.command()

    def step(self, t: float, h: float) -> None:
        self.command()
