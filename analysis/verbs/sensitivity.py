"""`perilune.sensitivity`: which dispersed inputs drive a campaign's metrics."""

from __future__ import annotations

import sys
from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from ...common.errors import suggestion
from ..options.declared.studies import SENSITIVITY, SensitivityOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..reports.common.notebook import Grid, notebook_view
from ..reports.common.panels import HALF_WIDTH
from ..reports.studies.sensitivity_page import (
    LANE,
    driver_table,
    rank_table,
    sensitivity_charts,
    write_sensitivity_page,
)
from ..studies import sensitivity as study
from .common.campaigns import commands_of, read_campaign
from .common.studies import Stored, condition_lines, conditions, results_folder, store_result

if TYPE_CHECKING:  # plots are imported where they are made: matplotlib takes as long as all the rest
    from matplotlib.figure import Figure as Plot

MOST_PLOTTED = 4  # metrics, in a notebook


@dataclass(frozen=True, eq=False, repr=False)
class SensitivityResult(Stored, study.SensitivityResult):
    """Sobol' indices of metrics and success: `of` gives those of one, ``ranks`` the rank correlations."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.facts['system']}, {self.flights} simulations: {', '.join(self.told)})"

    def write(self, folder: FilePath) -> None:
        """Write sensitivity.json, flights.parquet and draws.parquet."""
        super().write(Path(folder))

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune sensitivity --report`: one HTML file."""
        write_sensitivity_page(self, Path(path), self.folder)

    def plot(self, *metrics: str) -> Plot:
        """Total and first-order indices with their intervals, a panel for each metric; by default of all.

        Raises KeyError for a metric that has no indices, ValueError where none has any.
        """
        for name in metrics:
            if name not in self.told:
                raise KeyError(f"no indices of {name}; {suggestion(name, self.told)}")
        if not self.told:
            raise ValueError("no metric has indices")
        from ..reports.chart.plot import plot_charts

        charts = sensitivity_charts(self, metrics or self.told)
        height = 1.0 + LANE * max(len(chart.y.ticks) for chart in charts)
        titles = [f"{chart.title}: total, below it first order" for chart in charts]
        return plot_charts(charts, height, HALF_WIDTH, columns=min(2, len(charts)), titles=titles)

    def _repr_html_(self) -> str:
        grids = [Grid(table.heads, table.rows) for table in (driver_table(self), rank_table(self))]
        text = [f"{self.flights} simulations", *condition_lines(self)]
        plot = self.plot(*self.told[:MOST_PLOTTED]) if self.told else None
        return notebook_view(f"{self.facts['system']}: sensitivity", text, grids, plot)


@verb(SENSITIVITY)
def sensitivity(
    system: FilePath, campaign: FilePath, base: int, **options: Unpack[SensitivityOptions]
) -> SensitivityResult:
    """Sobol' indices of a campaign's metrics and of its success: `perilune sensitivity`.

    ``base`` is a power of two, 32 or more: that many times the number of dispersed inputs and 3 are simulated, or the
    number and 2 where no noise is random. The noise of all components is one input in addition to the dispersed ones.
    Jointly normal draws are refused. ``hold``, ``noise_trial`` and ``compare`` are as in `rare`; ``output`` is a folder
    for sensitivity.json, flights.parquet and draws.parquet. The rest is as in `batch`. Raises InputError.
    """
    folder = results_folder(options)
    plan = read_campaign(system, campaign, options)
    with chdir(Path.cwd()):  # an FMU may change the folder
        result = study.sensitivity(
            plan, base, **conditions(options), tell=lambda cost: print(f"perilune: {cost}", file=sys.stderr)
        )
    return store_result(SensitivityResult, replace(result, commands=commands_of(plan)), folder)
