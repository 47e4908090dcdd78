"""What a stability study finds: plain values, angles in rad, gains as factors, times in s, frequencies in rad/s."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from .margin_values import Margins, Quantity, order_statistic
from .readings import Classical, Curve, Robust
from .requirement import Requirement, Verdict, combined

LEVELS = {"least": 0.0, "5 %": 0.05, "50 %": 0.5}  # of dispersed margins


@dataclass(frozen=True)
class Mode:
    """A closed-loop mode over the ``period`` (s) of the linear model.

    ``z`` is the multiplier over one period, ``s`` the equivalent log(z)/period (rad/s; not unique above the
    Nyquist frequency of the period). ``kind`` is "loop" for modes that the cut can both move and see, else
    "not controllable", "not observable" or "neither". ``controllability`` and ``observability`` are the sizes of
    the mode's input and output vectors, scaled by the largest.
    """

    z: complex
    s: complex
    damping: float
    frequency: float
    kind: str
    controllability: float
    observability: float


@dataclass(frozen=True)
class Structure:
    """Ranks of the controllability and observability Gramians' factors and their smallest kept singular values."""

    states: int  # of the complete memory
    order: int  # of the part that the cut both moves and is moved by
    controllable: int
    observable: int
    least_controllable: float
    least_observable: float


@dataclass(frozen=True)
class RouteA:
    """How the Jacobian was made and how far it can be trusted."""

    states: int
    period: float  # s, over which the Jacobian was taken
    plateau: float  # largest relative change of a column between neighbouring steps of the difference
    doubtful: tuple[str, ...]  # memory whose columns have no plateau: kinks, switches
    periodicity: float  # largest share of the response that comes back at other frequencies; 0: time-invariant


@dataclass(frozen=True)
class RouteB:
    """How the injection was made and how far it can be trusted."""

    amplitude: float  # of one line, in the cut's unit
    lines: int
    periods: int
    period: float  # s, of the multisine
    half_amplitude_change: float  # largest relative change of L between full and half amplitude
    unexcited: float  # largest response on unexcited lines relative to the excited ones': nonlinearity, noise
    curve: Curve


@dataclass(frozen=True)
class Agreement:
    """The largest difference of the routes below half the Nyquist frequency."""

    gain: float  # factor, at least 1
    phase: float  # rad
    frequency: float  # rad/s, highest that was compared
    agrees: bool


@dataclass(frozen=True)
class AmplitudePoint:
    """Gain and phase of L at one frequency, measured with one amplitude of the injected signal (in its unit)."""

    amplitude: float
    value: complex
    change: float  # relative to the smallest amplitude's


@dataclass(frozen=True)
class LimitCycle:
    """A limit cycle predicted by harmonic balance, and what a simulation shows. Amplitudes at the element's input."""

    amplitude: float
    period: float  # s
    stable: bool
    simulated_amplitude: float | None  # None: the flight has no oscillation that lasts
    simulated_period: float | None


@dataclass(frozen=True)
class Nonlinearity:
    """An element of the loop with its describing function N(a), and the limit cycles that L and N predict."""

    name: str
    kind: str
    parameters: dict[str, float]
    unit: str | None  # of the amplitude
    amplitude: np.ndarray
    gain: np.ndarray  # complex N over amplitude
    cycles: tuple[LimitCycle, ...]
    note: str


@dataclass(frozen=True)
class Sampled:
    """The margins with another communication step (s); None where there are none, and ``note`` says why."""

    step: float
    margins: Margins | None
    note: str = ""


@dataclass(frozen=True)
class Dispersion:
    """Margins over the trials of a campaign.

    ``worst`` is the trial with the least disk margin, of unstable ones that with the largest multiplier, and ``replay``
    the command that studies it again. ``poles`` are all trials' closed-loop multipliers, side by side.
    """

    campaign: str
    margins: tuple[Margins, ...]
    poles: np.ndarray
    worst: int
    replay: str
    requirements: tuple[Requirement, ...]

    @property
    def trials(self) -> int:
        return len(self.margins)

    @property
    def unstable(self) -> int:
        """How many trials are unstable."""
        return sum(item.unstable for item in self.margins)

    def sizes(self, quantity: Quantity) -> np.ndarray:
        """A margin's size in every trial, `UNSTABLE` and `UNLIMITED` among them."""
        return np.array([item.size(quantity) for item in self.margins])

    def levels(self, quantity: Quantity) -> dict[str, float]:
        """Least, 5 % and median over all trials: order statistics, so each is the margin of a trial."""
        sizes = [item.size(quantity) for item in self.margins]
        return {name: order_statistic(sizes, level) for name, level in LEVELS.items()}


@dataclass
class LoopReport:
    """One loop at one operating point. ``curve`` is route A's, where there is one, else route B's."""

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
    stable: bool | None  # of the closed loop; None: not known
    largest: float | None  # multiplier of the closed loop's modes; None: not known
    unstable_open: int | None  # poles of the open loop outside the unit circle
    modes: tuple[Mode, ...] = ()
    poles_z: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=complex))
    structure: Structure | None = None
    route_a: RouteA | None = None
    route_b: RouteB | None = None
    agreement: Agreement | None = None
    not_applicable: dict[str, str] = field(default_factory=dict)  # "route A", "route B", ...: why not
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
    def verdict(self) -> Verdict:
        return combined(self.judged)


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

    @property
    def verdict(self) -> Verdict:
        return combined(self.requirements)


@dataclass(frozen=True)
class PointReport:
    """An operating point: where the system was linearised and how long the frozen view holds.

    ``time`` is that of the communication point (s); ``trim`` lists, for the memory that changes most over one
    period, name, value, change over the period and unit; ``drift`` is the largest relative change of a margin's
    frequency response over one further period, and ``holds`` how long (s) until it would be 10 % (inf: does not
    change).
    """

    name: str
    phase: str
    time: float
    settings: dict[str, Any]
    trim: tuple[tuple[str, float, float, str | None], ...]
    drift: float | None
    holds: float | None


@dataclass(frozen=True)
class SweepCrossing:
    """The value of the parameter at which a margin reaches its limit or, of stability, the loop becomes unstable.

    ``below``: the side that fails.
    """

    quantity: Quantity
    value: float
    below: bool


@dataclass(frozen=True)
class SweepReport:
    """Margins over one parameter, and the values at which each limit is crossed, ascending."""

    name: str
    loop: str
    parameter: str
    unit: str | None
    values: np.ndarray
    margins: tuple[Margins, ...]
    crossings: tuple[SweepCrossing, ...]


@dataclass(frozen=True)
class Unstudied:
    """Something that was asked for and could not be had: a loop at a point, its channels at once, a sweep."""

    name: str
    point: str
    what: str
    reason: str


class Judged(NamedTuple):
    """A requirement and what is judged by it."""

    subject: LoopReport | JointReport
    requirement: Requirement


@dataclass
class StabilityReport:
    """Everything about one system. ``unstudied`` is what could not be had, each with its reason."""

    system: str
    provenance: dict[str, Any]
    limits: dict[str, float]
    points: tuple[PointReport, ...]
    loops: tuple[LoopReport, ...]
    joint: tuple[JointReport, ...]
    sweeps: tuple[SweepReport, ...]
    unstudied: tuple[Unstudied, ...]
    seconds: float

    def judged(self) -> Iterator[Judged]:
        """Everything that is judged, with where it belongs."""
        for loop in self.loops:
            for requirement in loop.judged:
                yield Judged(loop, requirement)
        for joint in self.joint:
            for requirement in joint.requirements:
                yield Judged(joint, requirement)

    @property
    def verdict(self) -> Verdict:
        """What could not be studied is not passed."""
        found = combined([item.requirement for item in self.judged()])
        return Verdict.NOT_APPLICABLE if found is Verdict.PASS and self.unstudied else found
