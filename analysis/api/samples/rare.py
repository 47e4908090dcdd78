"""Rare failures from Python."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from matplotlib.figure import Figure as Plot

from ...common.targets import check_folder
from ...reports.common.notebook import Grid, notebook_view
from ...reports.studies.plots import rare_plot
from ...reports.studies.rare_page import design_table, level_table, write_rare_page
from ...runtime.ssp.parameter_sets import SetValue
from ...runtime.system.fault import Fault
from ...runtime.system.in_flight.series import Given
from ...studies.rare import outcome
from ...studies.rare.study import LEAST, SAMPLES, rare_failure
from ..options import Compared, FilePath
from .plans import commands_of, sample_plan
from .results import as_class, condition_words


@dataclass(frozen=True, eq=False, repr=False)
class RareResult(outcome.RareResult):
    """A rare failure: ``probability``, ``interval``, ``flights``, ``failures``, and the conditions of all of them.

    ``simulation`` has the levels, ``flown`` every simulation.
    """

    folder: Path | None = None

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.facts['system']}, {self.headline()})"

    def write(self, folder: FilePath) -> None:
        """Write rare.json, flights.parquet and, where there are failures, failures.parquet."""
        super().write(Path(folder))

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune rare --report`: one HTML file."""
        write_rare_page(self, Path(path), self.folder)

    def plot(self) -> Plot:
        """Limit state over simulations, exceedance probability, failures over the two most influential parameters."""
        return rare_plot(self)

    def _repr_html_(self) -> str:
        grids = [Grid(table.heads, table.rows) for table in (level_table(self), design_table(self))]
        words = [self.headline(), f"{self.flights} simulations", *condition_words(self)]
        return notebook_view(f"{self.facts['system']}: rare failure", words, grids, self.plot())


def rare(
    system: FilePath,
    campaign: FilePath,
    *,
    failure: str | None = None,
    samples: int | None = None,
    least: float | None = None,
    hold: Mapping[str, float] | None = None,
    noise_trial: int | None = None,
    compare: Compared | None = None,
    seed: int | None = None,
    workers: int | None = None,
    output: FilePath | None = None,
    overwrite: bool = False,
    use: Mapping[str, FilePath] | None = None,
    parameters: Sequence[FilePath] = (),
    set: Mapping[str, SetValue] | None = None,
    faults: Sequence[Fault | str] = (),
    input: Given | None = None,
    log: Literal["error", "warning", "info", "all"] | None = None,
    timeout: float | None = None,
    step: float | None = None,
    stop_time: float | None = None,
    algorithm: Literal["sequential", "jacobi"] | None = None,
    variant: str | None = None,
    flavour: Literal["native", "python"] | None = None,
    allow_unmatched: bool = False,
    strict: bool = False,
    open_inputs: Literal["refuse", "start"] = "refuse",
    feedthrough: Sequence[str] = (),
    no_feedthrough: Sequence[str] = (),
) -> RareResult:
    """The probability of a rare failure over a campaign's draws and noise, by subset simulation: `perilune rare`.

    ``failure`` is an expression over metrics and draws, by default that a trial is no success; ``samples`` are the
    flights of a level, by default 4500, and a failure less likely than ``least``, by default 1e-9, is given up.
    ``hold`` gives draws one value in all flights. The noise of components is random, unless ``noise_trial`` is the
    trial of the campaign whose noise all flights have: then the probability is conditional on that. ``compare`` says
    which FMU flies in a slot that the campaign compares; ``output`` is a folder for rare.json, flights.parquet and
    failures.parquet. The rest is as in `batch`. Raises InputError.
    """
    folder = Path(output).absolute() if output is not None else None
    check_folder("output", folder, overwrite=overwrite)
    plan = sample_plan(
        system, campaign, compare=compare, seed=seed, use=use, parameters=parameters, set=set, faults=faults,
        input=input, log=log, timeout=timeout, step=step, stop_time=stop_time, algorithm=algorithm, variant=variant,
        flavour=flavour, allow_unmatched=allow_unmatched, strict=strict, open_inputs=open_inputs,
        feedthrough=feedthrough,
        no_feedthrough=no_feedthrough,
    )  # fmt: skip
    with chdir(Path.cwd()):  # an FMU may change the folder
        result = rare_failure(
            plan, failure, hold=hold, noise_trial=noise_trial, workers=workers,
            samples=SAMPLES if samples is None else samples, least=LEAST if least is None else least,
        )  # fmt: skip
    result = replace(result, commands=commands_of(plan))
    if folder is not None:
        result.write(folder)
    return as_class(RareResult, result, folder=folder)
