"""Report of a study: points, loops, joint channels, failed parts. Angles are in rad; gains are factors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from ..loops.margin_values import LoopMargins
from ..loops.readings import Classical, FrequencyResponse, Robust
from .requirement import MarginRequirement, MarginVerdict, combine, combine_verdicts
from .responses import Agreement, AmplitudePoint, Linearised, Measured, Mode, Nonlinearity, StateSpace, Structure
from .varied import Dispersion, StepMargins, SweepReport


@dataclass
class LoopReport:
    """One loop at one operating point. ``curve`` is from the linearisation if there is one, else from the test."""

    name: str
    loop: str  # name of the declaration
    point: str  # name of the operating point
    cut: str
    returned: str  # return signal, by default at the cut
    unit: str | None
    sample_period: float  # s, of the loop
    closed: tuple[str, ...]  # other loops, which stay closed
    sign: str
    curve: FrequencyResponse
    classical: Classical
    robust: Robust
    stable: bool | None  # the whole system with all loops closed; None: unknown
    largest: float | None  # largest multiplier of the loop's modes and of growing memory outside; None: unknown
    unstable_open: int | None  # poles of the open loop outside the unit circle
    outside: tuple[str, ...] = ()  # memory that grows outside of this loop, while all loops are closed
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
    sampling: tuple[StepMargins, ...] = ()
    dispersion: Dispersion | None = None
    requirements: tuple[MarginRequirement, ...] = ()

    @property
    def margins(self) -> LoopMargins:
        """Nearest margins; an unstable loop has none."""
        return LoopMargins.of(self.classical, self.robust, self.stable, self.largest)

    @property
    def judged(self) -> tuple[MarginRequirement, ...]:
        """All requirements, with requirements on the dispersion last."""
        return self.requirements + (self.dispersion.requirements if self.dispersion is not None else ())

    @property
    def is_contradicted(self) -> bool:
        """True if linearised and measured response differ; no requirement can then pass."""
        return self.agreement is not None and not self.agreement.agrees

    @property
    def verdict(self) -> MarginVerdict:
        verdict = combine(self.judged)
        return MarginVerdict.NOT_APPLICABLE if verdict is MarginVerdict.PASS and self.is_contradicted else verdict


@dataclass(frozen=True)
class JointReport:
    """All channels of one loop opened at once, each with an independent perturbation (a multivariable disk margin).

    Unless the closed loop is ``stable``, the distances describe the response only and are not a margin.
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
    requirements: tuple[MarginRequirement, ...] = ()
    open_loop: StateSpace | None = None  # all channels open at once

    @property
    def verdict(self) -> MarginVerdict:
        return combine(self.requirements)


@dataclass(frozen=True)
class PointReport:
    """Operating point: where the system was linearised, and how long the frozen-time linearisation is valid.

    ``time`` (s) is the time of the communication point. ``trim`` lists name, value, change over the period and unit of
    the memory that changes most over one period. ``drift`` is the largest relative change of a margin's frequency
    response over one further period, and ``holds`` is the time (s) until this change would be 10 % (inf: no change).
    """

    name: str
    phase: str
    time: float
    settings: dict[str, object]
    trim: tuple[tuple[str, float, float, str | None], ...]
    drift: float | None
    holds: float | None


@dataclass(frozen=True)
class FailedStudy:
    """Requested result that could not be obtained: a loop at a point, its joint channels, a sweep.

    ``verdict`` follows from ``reason`` without margins: fail or not applicable; None if nothing was studied.
    """

    name: str
    point: str
    what: str
    reason: str
    verdict: MarginVerdict | None = None

    @property
    def text(self) -> str:
        """Reason, preceded by the verdict unless it is FAIL."""
        if self.verdict is MarginVerdict.FAIL:
            return self.reason
        if self.verdict is MarginVerdict.WITHHELD:
            return f"withheld: {self.reason}; with the other evaluation order the verdict is not known"
        return f"{self.verdict or 'not studied'}: {self.reason}"


class JudgedRequirement(NamedTuple):
    """Requirement with the loop to which it applies."""

    subject: LoopReport | JointReport
    requirement: MarginRequirement


@dataclass(frozen=True)
class Orders:
    """Study, in both orders, of loops with FMUs that have undeclared dependencies.

    ``undeclared`` maps components to the names of these FMUs, which simulations assume to have no feedthrough.
    ``report`` is the study in the other order, in which the components ``direct`` have feedthrough. The components
    ``without`` cannot have it, since it would close an algebraic loop, which the initialisation cuts at ``cuts``. If no
    component can have feedthrough there is only one order, and ``report`` is None.
    """

    undeclared: dict[str, str]
    direct: tuple[str, ...]
    without: tuple[str, ...]
    cuts: tuple[str, ...]
    report: StabilityStudy | None

    @property
    def fmus(self) -> str:
        """Components with their FMUs, as ``wheel (FMU lag)``."""
        return ", ".join(f"{name} (FMU {fmu})" for name, fmu in self.undeclared.items())


@dataclass
class StabilityStudy:
    """Report on one system.

    ``unstudied`` are the results that could not be obtained, each with its reason. ``orders`` is the study in the other
    order of FMUs with undeclared dependencies, None if no loop contains one.
    """

    system: str
    provenance: dict[str, Any]
    limits: dict[str, float]
    points: tuple[PointReport, ...]
    loops: tuple[LoopReport, ...]
    joint: tuple[JointReport, ...]
    sweeps: tuple[SweepReport, ...]
    unstudied: tuple[FailedStudy, ...]
    seconds: float
    orders: Orders | None = None

    def judgements(self) -> Iterator[JudgedRequirement]:
        """Yield every requirement with its loop."""
        for loop in self.loops:
            for requirement in loop.judged:
                yield JudgedRequirement(loop, requirement)
        for joint in self.joint:
            for requirement in joint.requirements:
                yield JudgedRequirement(joint, requirement)

    @property
    def verdict(self) -> MarginVerdict:
        """Overall verdict; loops without a study or with differing responses prevent a pass."""
        requirements = [item.requirement.verdict for item in self.judgements()]
        verdict = combine_verdicts([*requirements, *(lost.verdict for lost in self.unstudied if lost.verdict)])
        open_to_doubt = self.unstudied or any(loop.is_contradicted for loop in self.loops)
        return MarginVerdict.NOT_APPLICABLE if verdict is MarginVerdict.PASS and open_to_doubt else verdict
