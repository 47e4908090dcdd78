"""A trial of a stored campaign again, from Python: `replay`."""

from __future__ import annotations

from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from ...campaigns.fly.replay import replay_trial
from ...reports.figures.declaration.reading import read_figures
from ...verbs.run import Result
from ..options import FilePath


@dataclass(repr=False, kw_only=True)
class ReplayResult(Result):
    """A trial of a campaign as a flight with every signal; see `Result` for what it has, plots and page.

    ``success`` and ``metrics`` are those of the campaign, ``faults`` what flew in the trial. ``stored`` says whether
    the folder has the trial, ``differences`` how the flight differs from it: nothing on the machine that flew it.
    """

    configuration: str
    trial: int
    success: bool
    metrics: dict[str, float]
    faults: tuple[str, ...]
    stored: bool
    differences: tuple[str, ...]


def replay(
    folder: FilePath,
    trial: int,
    *,
    configuration: str | None = None,
    log: Literal["error", "warning", "info", "all"] | None = None,
    timeout: float | None = None,
) -> ReplayResult:
    """Fly a trial of a campaign's folder again, of the folder alone, to the last bit: `perilune replay`.

    ``folder`` is what `batch` wrote to its ``output``; ``configuration`` names the variant where the campaign compares
    several. ``log`` writes what FMUs say to standard error, ``timeout`` (s, wall clock) takes the place of the
    campaign's own. Raises InputError, and TimeoutError where a step of an FMU does not return.
    """
    with chdir(Path.cwd()):  # an FMU may change the folder
        replayed = replay_trial(Path(folder), trial, configuration, log=log, timeout=timeout)
    return ReplayResult(
        **vars(replayed.flight),
        prepared=replayed.prepared,
        figures=tuple(read_figures(replayed.prepared)),
        configuration=replayed.configuration,
        trial=trial,
        success=replayed.outcome.success,
        metrics=replayed.outcome.metrics,
        faults=replayed.faults,
        stored=replayed.stored,
        differences=replayed.differences,
    )
