"""Bank angle during an entry: a target with sign reversals, and a reference that follows the target."""

import math

from ..block import Block, Output, Outputs, Parameter, State
from ..interfaces.ports import entry, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import clip
from ..units import deg

NEVER = 1e9


class BankMethod(Enumeration):
    """Method by which the reference follows the target."""

    IDEAL = member("ideal")
    LIMITED = member("limited")
    TIME_OPTIMAL = member("time-optimal")


class BankProgramme(Block):
    """Target bank angle with up to two sign reversals, and a reference that follows the target.

    method 0, ideal: the reference is the target. method 1, limited: as method 0, but the regulator limits the bank
    error to largest_error. method 2, time-optimal: the reference accelerates with bank_acceleration c, coasts at a rate
    v of at most bank_rate and decelerates. For a change from γ_0 to γ_1 by an angle L with sign n:

        v = min(bank_rate, sqrt(L c))    t_1 = v/c    t_2 = L/v
        γ = γ_0 + n c t^2/2    if t <= t_1
        γ = γ_0 + n v (t - t_1/2)    if t <= t_2
        γ = γ_1 - n c (t_1 + t_2 - t)^2/2    if t <= t_1 + t_2

    Reversals at or after 1e9 s do not occur.

    Assumes a vehicle that rolls about its velocity and attains bank_acceleration and bank_rate.

    Source: Lapin, thesis, chapter 3.2. See docs/systems/entry_attitude.md.
    """

    default_step = 0.2

    first_target = Parameter(
        deg(60.0), unit="rad", description="target bank angle at the start; its sign changes at each reversal"
    )
    reversal_times = Parameter(
        [NEVER, NEVER], unit="s", minimum=0.0, description="times from the start to the bank reversals, ascending"
    )
    method = Parameter(
        BankMethod,
        start=BankMethod.TIME_OPTIMAL,
        description="method by which the reference follows the target bank angle",
    )
    bank_rate = Parameter(
        deg(12.0), unit="rad/s", minimum=1e-6, description="largest bank rate of the time-optimal reference"
    )
    bank_acceleration = Parameter(
        0.06, unit="rad/s2", minimum=1e-6, description="bank acceleration of the time-optimal reference"
    )
    largest_error = Parameter(
        deg(48.0), unit="rad", minimum=0.0, description="magnitude to which the limited method limits the bank error"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        description="sample period of the programme; 0: a sample at every communication point"
    )
    target_bank = entry.TARGET_BANK.output()
    reference = Outputs(entry.BankReference, prefix="reference_")
    error_limit = entry.ERROR_LIMIT.output()
    time_since_reversal = Output(
        NEVER, unit="s", description="time since the last commanded bank reversal; 1e9: no reversal yet"
    )
    start_time = State(0.0, unit="s", description="start time of the simulation")

    def initialize(self) -> None:
        self.programme(0.0)

    def programme(self, time: float) -> None:
        """Set the outputs for ``time`` (s) after the start."""
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
        """Set the reference between the target ``before`` (rad) and the present target, ``s`` (s) after the
        reversal.
        """
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
