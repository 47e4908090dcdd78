"""Verdicts on FMUs: what makes them as good as new between simulations."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from ..system.fmu import Fmu


class Renewal(StrEnum):
    """Means that makes an FMU as good as new for the next simulation."""

    RESET = "reset"
    INSTANCE = "instance"  # another one, in the same process
    PROCESS = "process"  # another one, which loads the FMU from files that are as unpacked
    IRREPRODUCIBLE = "irreproducible"  # it depends on what no process can renew, such as the clock


@dataclass(frozen=True)
class ResetVerdict:
    """The first means that was found to do; ``reason`` says what showed that those before it do not."""

    renewal: Renewal
    reason: str = ""

    @property
    def resets(self) -> bool:
        """True if a reset makes an instance as good as new."""
        return self.renewal is Renewal.RESET

    @property
    def needs_process(self) -> bool:
        """True if a process may simulate with the FMU once only."""
        return self.renewal in (Renewal.PROCESS, Renewal.IRREPRODUCIBLE)


RESETS = ResetVerdict(Renewal.RESET)
_verdicts: dict[str, ResetVerdict] = {}  # by the FMUs' digests


def verdict_in_cache(fmu: Fmu) -> ResetVerdict | None:
    """Return the verdict on an FMU, if there is one yet; our own reset, which their tests show."""
    return RESETS if fmu.is_self_contained else _verdicts.get(fmu.digest)


def store_verdict(digest: str, verdict: ResetVerdict) -> None:
    """Keep what a simulation, or another process, has shown of the FMU with this SHA-256."""
    _verdicts[digest] = verdict
