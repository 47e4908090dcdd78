"""Bank over the time of an entry: a target, and how to get from one to the next."""

import math

from ..block import Block, Output, Outputs, Parameter, State
from ..interfaces.ports import entry, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import clip
from ..units import deg

NEVER = 1e9


class BankMethod(Enumeration):
    """Motion of the reference to the target."""

    IDEAL = member("ideal")
    LIMITED = member("limited")
    TIME_OPTIMAL = member("time-optimal")


class BankProgramme(Block):
    """Target bank that changes its sign at up to two reversals, and the reference that leads there.

    method 0, ideal: the reference is the target. 1, limited: likewise, with a limit on the error that the regulator
    may act on. 2, time-optimal: the reference accelerates with bank_acceleration, coasts at bank_rate at most, and
    brakes likewise, the quickest way within both (a limit on the rate is one on propellant). Reversals at or after 1e9
    s do not come. Equations: docs/systems/entry_attitude.md. Source: Lapin, thesis, chapter 3.2; numbers ours.
    Assumes a vehicle that rolls about its velocity and reaches bank_acceleration and bank_rate.
    """

    default_step = 0.2

    first_target = Parameter(deg(60.0), unit="rad", description="target at the start; it changes its sign")
    reversal_times = Parameter(
        [NEVER, NEVER], unit="s", minimum=0.0, description="of the reversals after the start, in order"
    )
    method = Parameter(BankMethod, start=BankMethod.TIME_OPTIMAL)
    bank_rate = Parameter(deg(12.0), unit="rad/s", minimum=1e-6, description="largest rate, time-optimal")
    bank_acceleration = Parameter(0.06, unit="rad/s2", minimum=1e-6, description="acceleration, time-optimal")
    largest_error = Parameter(deg(48.0), unit="rad", minimum=0.0, description="of the limited method")
    sample_period = sampling.SAMPLE_PERIOD.parameter(description="tick; 0: every communication point")
    target_bank = entry.TARGET_BANK.output()
    reference = Outputs(entry.BankReference, prefix="reference_")
    error_limit = entry.ERROR_LIMIT.output()
    time_since_reversal = Output(NEVER, unit="s", description="since the last reversal was commanded; 1e9 before")
    start_time = State(0.0, unit="s", description="start of the flight")

    def initialize(self) -> None:
        self.programme(0.0)

    def programme(self, time: float) -> None:
        """Set outputs ``time`` (s) after the start."""
        self.target_bank = self.first_target
        self.time_since_reversal = NEVER
        before = self.first_target
        for k in range(2):
            if time >= self.reversal_times[k]:
                before = self.target_bank
                self.target_bank = -self.target_bank
                self.time_since_reversal = time - self.reversal_times[k]
        self.reference.bank = self.target_bank
        self.reference.bank_rate = 0.0
        self.reference.bank_acceleration = 0.0
        self.error_limit = math.pi
        if self.method == BankMethod.LIMITED:
            self.error_limit = self.largest_error
        if self.method == BankMethod.TIME_OPTIMAL and self.time_since_reversal < NEVER:
            self.lead(before, self.time_since_reversal)

    def lead(self, before: float, s: float) -> None:
        """Lead the reference from one target to the present one, ``s`` (s) after the command."""
        way = abs(self.target_bank - before)
        if way <= 0.0:
            return
        sign = math.copysign(1.0, self.target_bank - before)
        c = self.bank_acceleration
        speed = clip(math.sqrt(way * c), 0.0, self.bank_rate)
        gather = speed / c
        coast_end = way / speed
        if s < gather:
            self.reference.bank = before + sign * 0.5 * c * s * s
            self.reference.bank_rate = sign * c * s
            self.reference.bank_acceleration = sign * c
        elif s < coast_end:
            self.reference.bank = before + sign * speed * (s - 0.5 * gather)
            self.reference.bank_rate = sign * speed
        elif s < gather + coast_end:
            left = gather + coast_end - s
            self.reference.bank = self.target_bank - sign * 0.5 * c * left * left
            self.reference.bank_rate = sign * c * left
            self.reference.bank_acceleration = -sign * c

    def step(self, t: float, h: float) -> None:
        self.programme(t + h - self.start_time)
