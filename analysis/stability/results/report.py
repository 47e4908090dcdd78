"""A whole study: its points, loops, sweeps, and what could not be had."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from .loop import JointReport, LoopReport
from .requirement import Requirement, Verdict, combine
from .varied import SweepReport


@dataclass(frozen=True)
class PointReport:
    """An operating point: where the system was linearised and how long the frozen-time linearisation is valid.

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


@dataclass(frozen=True)
class Orders:
    """A study of loops that pass FMUs with undeclared dependencies, made in both orders.

    ``undeclared`` are these FMUs' names by component, assumed to have no feedthrough in what flies; ``direct`` are the
    components that have it in ``report``, the study in the other order. ``without`` are those that cannot have it
    with the others: it would close an algebraic loop, which the initialisation cuts at ``cuts``. The report is None
    where none can have it, and then there is one order only.
    """

    undeclared: dict[str, str]
    direct: tuple[str, ...]
    without: tuple[str, ...]
    cuts: tuple[str, ...]
    report: StabilityReport | None

    @property
    def fmus(self) -> str:
        """The components with their FMUs, as ``wheel (FMU lag)``."""
        return ", ".join(f"{name} (FMU {fmu})" for name, fmu in self.undeclared.items())


@dataclass
class StabilityReport:
    """Everything about one system. ``unstudied`` is what could not be had, each with its reason.

    ``orders``: the other order of undeclared FMUs, None where no loop passes one.
    """

    system: str
    provenance: dict[str, Any]
    limits: dict[str, float]
    points: tuple[PointReport, ...]
    loops: tuple[LoopReport, ...]
    joint: tuple[JointReport, ...]
    sweeps: tuple[SweepReport, ...]
    unstudied: tuple[Unstudied, ...]
    seconds: float
    orders: Orders | None = None

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
        """What could not be studied, or what linearised and measured responses differ on, is not passed."""
        verdict = combine([item.requirement for item in self.judged()])
        open_to_doubt = self.unstudied or any(loop.doubted for loop in self.loops)
        return Verdict.NOT_APPLICABLE if verdict is Verdict.PASS and open_to_doubt else verdict
