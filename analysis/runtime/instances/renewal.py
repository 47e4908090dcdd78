"""Verdicts on the ways to restore FMUs to their initial state between simulations."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from ..system.fmu import Fmu


class Renewal(StrEnum):
    """Way to restore an FMU to its initial state for the next simulation."""

    RESET = "reset"
    INSTANCE = "instance"  # a new instance in the same process
    PROCESS = "process"  # a new process, which loads the FMU from freshly unpacked files
    IRREPRODUCIBLE = "irreproducible"  # results depend on something that no process restores, such as the clock


@dataclass(frozen=True)
class ResetVerdict:
    """Cheapest way to restore an FMU; ``reason`` states why cheaper ways fail."""

    renewal: Renewal
    reason: str = ""

    @property
    def resets(self) -> bool:
        """True if a reset restores an instance completely."""
        return self.renewal is Renewal.RESET

    @property
    def needs_process(self) -> bool:
        """True if the FMU needs a new process for every simulation."""
        return self.renewal in (Renewal.PROCESS, Renewal.IRREPRODUCIBLE)


RESETS = ResetVerdict(Renewal.RESET)
_verdicts: dict[str, ResetVerdict] = {}  # by the FMUs' digests


def verdict_in_cache(fmu: Fmu) -> ResetVerdict | None:
    """Return the verdict on an FMU if it is known, else None. Perilune's FMUs can be reset, as their tests verify."""
    return RESETS if fmu.is_self_contained else _verdicts.get(fmu.digest)


def store_verdict(digest: str, verdict: ResetVerdict) -> None:
    """Store a verdict on the FMU with this SHA-256 that was found by a simulation or by another process."""
    _verdicts[digest] = verdict
