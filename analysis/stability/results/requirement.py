"""Requirement on a margin: limit, value and verdict."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum

from ..loops.margin_values import UNSTABLE, MarginQuantity


class Scope(StrEnum):
    """Scope of a requirement: one loop, its trials, or all channels of a loop at once."""

    NOMINAL = "nominal"
    DISPERSED = "dispersed"
    JOINT = "joint"


class MarginVerdict(StrEnum):
    PASS = "pass"
    FAIL = "fail"
    WITHHELD = "withheld"  # depends on undeclared dependencies of an FMU
    NOT_APPLICABLE = "not applicable"


@dataclass(frozen=True)
class MarginRequirement:
    """Requirement on a margin; ``value`` and ``limit`` are in the quantity's unit, as shown; ``note`` is optional.

    The value may be `UNSTABLE` or `UNLIMITED`, or None if it is unknown; ``passed`` is then None, not applicable.
    ``as_feedthrough`` is the same requirement with feedthrough in FMUs with undeclared dependencies, None if the study
    has one order only: it passes if both pass and fails if both fail.
    """

    scope: Scope
    quantity: MarginQuantity
    value: float | None
    limit: float
    passed: bool | None
    note: str = ""
    as_feedthrough: MarginRequirement | None = None

    @classmethod
    def at_least(
        cls, scope: Scope, quantity: MarginQuantity, value: float, limit: float, note: str = ""
    ) -> MarginRequirement:
        """Return the requirement that a margin is at least its limit; an unstable loop's margin is below any limit."""
        return cls(scope, quantity, value, limit, value >= limit, note)

    @property
    def verdict(self) -> MarginVerdict:
        verdict = {True: MarginVerdict.PASS, False: MarginVerdict.FAIL, None: MarginVerdict.NOT_APPLICABLE}[self.passed]
        return (
            verdict
            if self.as_feedthrough is None or self.as_feedthrough.passed is self.passed
            else MarginVerdict.WITHHELD
        )

    @property
    def unit(self) -> str:
        return self.quantity.unit

    @property
    def unstable(self) -> bool:
        """True if the requirement fails because the loop is unstable and has no margin."""
        return self.value == UNSTABLE

    @property
    def title(self) -> str:
        """Scope and quantity as text: ``dispersed gain margin``."""
        if self.quantity is MarginQuantity.STABILITY:
            return "spectral radius" if self.scope is Scope.NOMINAL else "share of stable trials"
        return self.quantity if self.scope is Scope.NOMINAL else f"{self.scope} {self.quantity}"


def combine(requirements: Iterable[MarginRequirement]) -> MarginVerdict:
    """Return the verdict of all requirements."""
    return combine_verdicts(requirement.verdict for requirement in requirements)


def combine_verdicts(verdicts: Iterable[MarginVerdict]) -> MarginVerdict:
    """Return the first of fail, withheld and pass that is among the verdicts; not applicable if none is."""
    known = set(verdicts)
    return next(
        (token for token in (MarginVerdict.FAIL, MarginVerdict.WITHHELD, MarginVerdict.PASS) if token in known),
        MarginVerdict.NOT_APPLICABLE,
    )


def describe_instability(outside: Sequence[str], most: int = 4) -> str:
    """Return a text on the instability outside of a loop."""
    if not outside:
        return ""
    more = f" and {len(outside) - most} more" if len(outside) > most else ""
    return f"the instability is outside of this loop: {', '.join(outside[:most])}{more}"
