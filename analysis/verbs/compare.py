"""`perilune.compare` and `perilune compare`: variants of stored campaigns side by side, on the same trials."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from ...common.errors import InputError, suggestion
from ...common.percent import short_percent
from ..campaigns.compare import comparison
from ..campaigns.compare.side_by_side import compare_folders
from ..campaigns.summary import summary_rows
from ..campaigns.tables import who_cells, who_heads
from ..options.command import write_command
from ..options.declared.campaigns import COMPARE, CompareOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.flight.results import require_pandas
from .common.arguments import path_list
from .result import NoProblems

if TYPE_CHECKING:  # plots and pages are imported where they are made
    from matplotlib.figure import Figure as Plot

MOST_PLOTTED = 6  # metrics, in a notebook


@dataclass(frozen=True, repr=False)
class Comparison(NoProblems, comparison.Comparison):
    """Variants on the same trials: ``summary`` by label, ``pairs`` of labels, `compare_rates`, `compare_values`."""

    displayed: tuple[str, ...] = ()  # metrics of the option `metrics`

    def __repr__(self) -> str:
        trials = len(next(iter(self.contenders.values())).trials.trial)
        return f"{type(self).__name__}({', '.join(self.contenders)}; {trials} trials)"

    def to_pandas(self) -> Any:
        """Statistics as a pandas.DataFrame, a row per metric, variant and group; needs pandas."""
        require_pandas()
        from pandas import DataFrame

        rows = [
            {"metric": metric, "variant": row.variant, "group": row.group, **asdict(values)}
            for row in summary_rows(self.summary)
            for metric, values in row.entry.metrics.items()
        ]
        return DataFrame(rows)

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune compare --report`: one HTML file."""
        from ..reports.compare.page import write_comparison_page

        folders = [batch.folder for batch in self.batches.values()]
        command = write_command(COMPARE, {"results": folders}, {"reference": self.reference})
        write_comparison_page(self, Path(path), command)

    def lines(self) -> list[str]:
        """What `perilune compare` prints."""
        return self.text(self.displayed).splitlines()

    def to_json(self) -> dict[str, object]:
        """Provenance of every batch, numbers of every variant and of every pair, for other programs."""
        return self.content()

    def plot(self, *metrics: str) -> Plot:
        """How metrics are distributed over successful trials, contender over contender; of none named all that vary.

        Raises KeyError for a metric that no batch has, and ValueError where there is none to draw.
        """
        from ..reports.compare.metrics import metric_plot, varying_metrics

        known = {metric.name: metric for metric in self.metrics}
        for name in metrics:
            if name not in known:
                raise KeyError(f"no metric {name}; {suggestion(name, known)}")
        sampled = [known[name] for name in metrics] or varying_metrics(self)
        if not sampled:
            raise ValueError("no metric that varies and is finite anywhere")
        return metric_plot(self, sampled)

    def _repr_html_(self) -> str:
        from ..reports.common.notebook import Grid, metric_grid, notebook_view
        from ..reports.compare.metrics import metric_plot, varying_metrics

        names = [comparison.name_of(rate) for rate in self.rates]
        rows = summary_rows(self.summary)
        rates = [
            (
                *who_cells(row, self.group),
                str(row.entry.trials),
                *(comparison.rate_text(row.entry.rates[name], short_percent) for name in names),
            )
            for row in rows
        ]
        grids = [
            Grid((*who_heads(self.group), "trials", *(f"{name}, %" for name in names)), rates),
            metric_grid(rows, [metric.name for metric in self.metrics], self.group),
        ]
        sampled = varying_metrics(self)[:MOST_PLOTTED]
        system = self.first.document["system"]
        words = [f"{len(self.contenders)} variants on the same trials", *self.notes]
        return notebook_view(system, words, grids, metric_plot(self, sampled) if sampled else None)


@verb(COMPARE)
def compare(*results: FilePath | Sequence[FilePath], **options: Unpack[CompareOptions]) -> Comparison:
    """Put the variants of stored campaigns side by side: `perilune compare`.

    ``results`` are folders that `batch` wrote to its ``output``, or a list of them, all simulated on the same draws;
    ``reference`` names the variant that others are compared with, by default the first; ``metrics`` are those that
    the command line prints. Raises InputError.
    """
    folders = [Path(folder) for folder in path_list(results)]
    if not folders:
        raise InputError("compare", "", "no folder of results", "name what batch(..., output=...) wrote")
    compared = compare_folders(Comparison, folders, options["reference"])
    compared.text(options["metrics"])  # which refuses names that it does not have
    return replace(compared, displayed=tuple(options["metrics"]))
