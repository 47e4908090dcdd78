"""Worst cases from Python."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

from matplotlib.figure import Figure as Plot

from ...campaigns.spec.plan import BatchPlan
from ...common.targets import check_folder
from ...reports.common.notebook import Grid, notebook_view
from ...reports.studies.plots import worst_plot
from ...reports.studies.worst_flight import worst_flight
from ...reports.studies.worst_page import metric_table, parameter_table, write_worst_page
from ...runtime.ssp.parameter_sets import SetValue
from ...runtime.system.fault import Fault
from ...runtime.system.in_flight.series import Given
from ...studies.worst import outcome
from ...studies.worst.request import check_options, margin_asked
from ...studies.worst.study import MARGIN, worst_case, worst_margin
from ..options import Compared, FilePath, system_options
from .plans import commands_of, sample_plan
from .results import as_class, condition_words


@dataclass(frozen=True, eq=False, repr=False)
class WorstResult(outcome.WorstResult):
    """A worst case: ``worst`` and ``worst_random`` with their draws and metrics, and every simulation in ``flown``.

    ``plan`` is what flew; None where a margin was studied.
    """

    plan: BatchPlan | None = None
    folder: Path | None = None

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.facts['system']}, {self.headline()[0]})"

    def write(self, folder: FilePath) -> None:
        """Write worst.json, flights.parquet and worst.parquet."""
        super().write(Path(folder))

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune worst --report`: one HTML file. The worst case is flown once more for it."""
        with chdir(Path.cwd()):  # an FMU may change the folder
            target = Path(path).absolute()
            flight, figures = (None, []) if self.plan is None else worst_flight(self, self.plan)
        write_worst_page(self, target, flight, figures, self.folder)

    def plot(self) -> Plot:
        """The search over simulations, and the random trials with the worst case."""
        return worst_plot(self)

    def _repr_html_(self) -> str:
        grids = [Grid(table.heads, table.rows) for table in (parameter_table(self), metric_table(self))]
        words = [*self.headline(), *condition_words(self)]
        return notebook_view(f"{self.facts['system']}: worst case", words, grids, self.plot())


def worst(
    system: FilePath,
    campaign: FilePath,
    *,
    metric: str | None = None,
    loop: str | None = None,
    margin: Literal["disk", "modulus", "gain", "phase", "delay"] | None = None,
    point: str | None = None,
    at: float | None = None,
    sigmas: float | None = None,
    flights: int | None = None,
    hold: Mapping[str, float] | None = None,
    noise_trial: int | None = None,
    realisations: int | None = None,
    quantile: float | None = None,
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
) -> WorstResult:
    """The draws that make a number worst, within a box of a campaign's draws: `perilune worst`.

    ``metric`` is an expression over metrics and draws, the larger the worse, by default the margin by which a trial is
    no success. In its place the least ``margin`` of a ``loop`` is looked for, by default the disk margin: a loop that
    the system names, at an operating ``point`` of it, or a connector to cut at the time ``at`` (s); an unstable loop is
    worse than any margin, and ``compare``, ``faults``, ``input``, ``log`` and ``timeout`` do not go with one.

    ``sigmas`` is the box of normal draws, by default 3, others have their own ends; ``flights`` are by default 2000, of
    a margin 500. Where components have noise, every point flies the same ``realisations`` of it, by default 5, of a
    margin 1, whose ``quantile`` is made largest, by default 0.5, the median; the point that wins flies ten times as
    many fresh ones. ``hold``, ``noise_trial`` and ``compare`` are as in `rare`; ``output`` is a folder for worst.json,
    flights.parquet and worst.parquet. The rest is as in `batch`. Raises InputError.
    """
    folder = Path(output).absolute() if output is not None else None
    check_folder("output", folder, overwrite=overwrite)
    given = {
        "metric": metric, "margin": margin, "point": point, "at": at, "compare": compare, "fault": faults,
        "input": input, "log": log, "timeout": timeout,
    }  # fmt: skip
    check_options(loop, given)
    search: dict[str, Any] = {
        "hold": hold, "noise_trial": noise_trial, "realisations": realisations, "quantile": quantile,
        "workers": workers,
    }  # fmt: skip
    search |= {name: value for name, value in (("sigmas", sigmas), ("flights", flights)) if value is not None}
    plan = None
    if loop is None:
        plan = sample_plan(
            system, campaign, compare=compare, seed=seed, use=use, parameters=parameters, set=set, faults=faults,
            input=input, log=log, timeout=timeout, step=step, stop_time=stop_time, algorithm=algorithm,
            variant=variant, flavour=flavour, allow_unmatched=allow_unmatched, strict=strict, open_inputs=open_inputs,
            feedthrough=feedthrough,
            no_feedthrough=no_feedthrough,
        )  # fmt: skip
        with chdir(Path.cwd()):  # an FMU may change the folder
            result = replace(worst_case(plan, metric, **search), again=commands_of(plan).replay)
    else:
        options = system_options(
            use, parameters, set, feedthrough, no_feedthrough, step=step, stop_time=stop_time, algorithm=algorithm,
            variant=variant, flavour=flavour, allow_unmatched=allow_unmatched, strict=strict, open_inputs=open_inputs,
        )  # fmt: skip
        asked = margin_asked(Path(system), options, campaign=str(campaign), loop=loop, point=point, at=at, seed=seed)
        with chdir(Path.cwd()):
            result = worst_margin(asked, margin or MARGIN, **search)
    if folder is not None:
        result.write(folder)
    return as_class(WorstResult, result, plan=plan, folder=folder)
