"""What drives a campaign's metrics, from Python."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from matplotlib.figure import Figure as Plot

from ...common.errors import suggestion
from ...common.targets import check_folder
from ...reports.common.notebook import Grid, notebook_view
from ...reports.studies.plots import sensitivity_plot
from ...reports.studies.sensitivity_page import driver_table, rank_table, write_sensitivity_page
from ...runtime.ssp.parameter_sets import SetValue
from ...runtime.system.fault import Fault
from ...runtime.system.in_flight.series import Given
from ...studies.sensitivity import outcome, study
from ..options import Compared, FilePath
from .plans import commands_of, sample_plan
from .results import as_class, condition_words

MOST_PLOTTED = 4  # metrics, in a notebook


@dataclass(frozen=True, eq=False, repr=False)
class SensitivityResult(outcome.SensitivityResult):
    """Sobol' indices of metrics and success: `of` gives those of one, ``ranks`` the rank correlations."""

    folder: Path | None = None

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.facts['system']}, {self.flights} simulations: {', '.join(self.told)})"

    def write(self, folder: FilePath) -> None:
        """Write sensitivity.json, flights.parquet and draws.parquet."""
        super().write(Path(folder))

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune batch --sensitivity N --report`: one HTML file."""
        write_sensitivity_page(self, Path(path), self.folder)

    def plot(self, *metrics: str) -> Plot:
        """Total and first-order indices with their intervals, a panel for each metric; of none named all.

        Raises KeyError for a metric that has no indices, ValueError where none has any.
        """
        for name in metrics:
            if name not in self.told:
                raise KeyError(f"no indices of {name}; {suggestion(name, self.told)}")
        if not self.told:
            raise ValueError("no metric has indices")
        return sensitivity_plot(self, list(metrics or self.told))

    def _repr_html_(self) -> str:
        grids = [Grid(table.heads, table.rows) for table in (driver_table(self), rank_table(self))]
        words = [f"{self.flights} simulations", *condition_words(self)]
        plot = self.plot(*self.told[:MOST_PLOTTED]) if self.told else None
        return notebook_view(f"{self.facts['system']}: sensitivity", words, grids, plot)


def sensitivity(
    system: FilePath,
    campaign: FilePath,
    base: int,
    *,
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
) -> SensitivityResult:
    """Sobol' indices of a campaign's metrics and of its success: `perilune batch --sensitivity`.

    ``base`` is a power of two: that many times the number of draws and 3 are flown, or the number of draws and 2 where
    no noise is random. The noise of all components is one input beside the draws. Draws that are jointly normal are
    refused. ``hold``, ``noise_trial`` and ``compare`` are as in `rare`; ``output`` is a folder for sensitivity.json,
    flights.parquet and draws.parquet. The rest is as in `batch`. Raises InputError.
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
        result = study.sensitivity(plan, base, hold=hold, noise_trial=noise_trial, workers=workers)
    result = replace(result, commands=commands_of(plan))
    if folder is not None:
        result.write(folder)
    return as_class(SensitivityResult, result, folder=folder)
