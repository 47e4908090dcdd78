"""What a stability study finds: plain values, angles in rad, gains as factors, times in s, frequencies in rad/s."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Crossing:
    """A gain or phase margin where the loop's frequency response crosses the critical ray or the unit circle.

    ``value`` is the factor on the gain that makes the loop marginal (above 1: a margin upwards, below 1:
    downwards), or the phase lag (rad, positive; negative: a lead) that does; ``frequency`` in rad/s.
    """

    value: float
    frequency: float


@dataclass(frozen=True)
class Classical:
    """Every crossing of one loop. Infinite margins are empty tuples. Encirclements of -1 are counter-clockwise."""

    gain: tuple[Crossing, ...]
    phase: tuple[Crossing, ...]
    delay_margin: float  # s; inf: none
    delay_frequency: float  # rad/s, at which the delay margin is reached; nan: none
    encirclements: int | None  # None: not counted, since nothing is known about poles

    @property
    def gain_margin(self) -> Crossing | None:
        """The crossing nearest to 1 in dB, up or down."""
        return min(self.gain, key=lambda crossing: abs(np.log(crossing.value)), default=None)

    @property
    def phase_margin(self) -> Crossing | None:
        """The crossing nearest to 0, lag or lead."""
        return min(self.phase, key=lambda crossing: abs(crossing.value), default=None)


@dataclass(frozen=True)
class Robust:
    """Distances from -1. Peaks of |S| and |T| with their frequencies (rad/s); disk margin alpha with skew 0."""

    modulus_margin: float
    sensitivity_peak: float
    sensitivity_frequency: float
    complementary_peak: float
    complementary_frequency: float
    disk_margin: float
    disk_gain: float  # the factor up, and 1/factor down, that the disk margin guarantees
    disk_phase: float  # rad
    disk_frequency: float


@dataclass(frozen=True)
class Curve:
    """A frequency response: angular frequencies (rad/s) and complex values of L, minus the loop's transfer."""

    frequency: np.ndarray
    value: np.ndarray


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
class Requirement:
    """A limit, what was found and whether it holds. ``passed`` None: not applicable, and ``note`` says why.

    ``quantity`` is a word such as "gain margin"; ``value`` and ``limit`` are in ``unit`` ("dB", "deg", "s", "1"),
    as they are shown.
    """

    quantity: str
    value: float | None
    limit: float
    unit: str
    passed: bool | None
    note: str = ""


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
    """The margins with another communication step; ``note`` says why there are none."""

    step: float
    gain_margin: float | None  # factor
    phase_margin: float | None  # rad
    note: str = ""


@dataclass(frozen=True)
class Dispersion:
    """Margins over the trials of a campaign: arrays over trials, nan where a trial has none.

    ``worst`` is the trial with the least disk margin and ``replay`` the command that flies it again.
    ``poles`` are all trials' closed-loop multipliers, side by side.
    """

    campaign: str
    trials: int
    gain_margin: np.ndarray  # factor
    phase_margin: np.ndarray  # rad
    modulus_margin: np.ndarray
    disk_margin: np.ndarray
    stable: np.ndarray  # bool
    poles: np.ndarray
    worst: int
    replay: str
    requirements: tuple[Requirement, ...]


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
    def verdict(self) -> str:
        """``pass``, ``fail`` or ``not applicable``."""
        judged = [requirement.passed for requirement in self.requirements if requirement.passed is not None]
        if self.dispersion is not None:
            judged += [item.passed for item in self.dispersion.requirements if item.passed is not None]
        if not judged:
            return "not applicable"
        return "pass" if all(judged) else "fail"


@dataclass(frozen=True)
class JointReport:
    """All channels of one loop opened at once, with independent scaling of each (a multivariable disk margin)."""

    name: str
    point: str
    channels: tuple[str, ...]
    disk_margin: float
    disk_gain: float  # factor
    disk_phase: float  # rad
    disk_frequency: float
    frequency: np.ndarray
    disk_margins: np.ndarray  # over frequency
    requirements: tuple[Requirement, ...] = ()


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
class SweepReport:
    """Margins over one parameter, and the values at which each limit is crossed."""

    name: str
    loop: str
    parameter: str
    unit: str | None
    values: np.ndarray
    gain_margin: np.ndarray  # factor
    phase_margin: np.ndarray  # rad
    crossings: dict[str, float]  # by requirement


@dataclass(frozen=True)
class Unstudied:
    """Something that was asked for and could not be had: a loop at a point, its channels at once, a sweep."""

    name: str
    point: str
    what: str
    reason: str


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

    @property
    def verdict(self) -> str:
        verdicts = [loop.verdict for loop in self.loops]
        verdicts += ["fail" for joint in self.joint for item in joint.requirements if item.passed is False]
        if "fail" in verdicts:
            return "fail"
        return "pass" if "pass" in verdicts and not self.unstudied else "not applicable"
