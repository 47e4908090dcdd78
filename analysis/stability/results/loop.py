"""What a study finds of one loop at one point, and of its channels at once. Angles in rad, gains as factors."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..loops.margin_values import Margins
from ..loops.readings import Classical, Curve, Robust
from .nonlinear import AmplitudePoint, Nonlinearity
from .requirement import Requirement, Verdict, combine
from .responses import Agreement, Linearised, Measured, Mode, Structure
from .state_space import StateSpace
from .varied import Dispersion, Sampled


@dataclass
class LoopReport:
    """One loop at one operating point. ``curve`` is the linearisation's, where there is one, else the test's."""

    name: str
    loop: str  # name of the declaration
    point: str  # name of the operating point
    cut: str
    returned: str  # signal that comes back, the cut's own unless declared otherwise
    unit: str | None
    sample_period: float  # s, of the loop
    closed: tuple[str, ...]  # other loops, which stay closed
    sign: str
    curve: Curve
    classical: Classical
    robust: Robust
    stable: bool | None  # of the whole system, all loops closed; None: not known
    largest: float | None  # multiplier of the loop's modes and of what grows outside of it; None: not known
    unstable_open: int | None  # poles of the open loop outside the unit circle
    outside: tuple[str, ...] = ()  # memory that grows without any part in this loop, while all loops are closed
    modes: tuple[Mode, ...] = ()
    poles_z: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=complex))
    structure: Structure | None = None
    open_loop: StateSpace | None = None  # None: no linear model that can be trusted
    linearised: Linearised | None = None
    measured_response: Measured | None = None
    agreement: Agreement | None = None
    not_applicable: dict[str, str] = field(
        default_factory=dict
    )  # "linearisation", "frequency-response test", ...: why not
    step: tuple[np.ndarray, np.ndarray] | None = None  # time (s) and response of T to a step at the cut
    amplitudes: tuple[AmplitudePoint, ...] = ()
    amplitude_frequency: float | None = None
    nonlinearities: tuple[Nonlinearity, ...] = ()
    sampling: tuple[Sampled, ...] = ()
    dispersion: Dispersion | None = None
    requirements: tuple[Requirement, ...] = ()

    @property
    def margins(self) -> Margins:
        """The nearest margins; of an unstable loop there are none."""
        return Margins.of(self.classical, self.robust, self.stable, self.largest)

    @property
    def judged(self) -> tuple[Requirement, ...]:
        """All requirements, those of the dispersion last."""
        return self.requirements + (self.dispersion.requirements if self.dispersion is not None else ())

    @property
    def doubted(self) -> bool:
        """Whether linearised and measured response differ: then nothing that was read off one of them can pass."""
        return self.agreement is not None and not self.agreement.agrees

    @property
    def verdict(self) -> Verdict:
        verdict = combine(self.judged)
        return Verdict.NOT_APPLICABLE if verdict is Verdict.PASS and self.doubted else verdict


@dataclass(frozen=True)
class JointReport:
    """All channels of one loop opened at once, with independent scaling of each (a multivariable disk margin).

    Where the closed loop is not ``stable`` the distances are of the response only: it has no margin.
    """

    name: str
    point: str
    channels: tuple[str, ...]
    stable: bool
    disk_margin: float
    disk_gain: float  # factor
    disk_phase: float  # rad
    disk_frequency: float
    frequency: np.ndarray
    disk_margins: np.ndarray  # over frequency
    requirements: tuple[Requirement, ...] = ()
    open_loop: StateSpace | None = None  # all channels open at once

    @property
    def verdict(self) -> Verdict:
        return combine(self.requirements)
