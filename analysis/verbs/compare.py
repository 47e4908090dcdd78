"""`perilune.compare` and `perilune compare`: variants of stored campaigns side by side, on the same trials."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from ...common.errors import InputError, suggestion
from ..campaigns.compare import campaign_comparison
from ..campaigns.compare.side_by_side import compare_folders
from ..campaigns.summary import summary_rows
from ..documents.model import Document
from ..documents.of.comparison.comparison import comparison_document
from ..options.command import write_command
from ..options.declared.campaigns import COMPARE, CompareOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.flight.results import require_pandas
from .common.arguments import path_list
from .common.documented import Documented

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Plot


@dataclass(frozen=True, repr=False)
class Comparison(Documented, campaign_comparison.CampaignComparison):
    """Comparison of variants on the same trials, with a ``summary`` by label and ``pairs`` of labels.

    `compare_rates` and `compare_values` compare a pair.
    """

    displayed: tuple[str, ...] = ()  # metrics of the option `metrics`

    def __repr__(self) -> str:
        trials = len(next(iter(self.contenders.values())).trials.trial)
        return f"{type(self).__name__}({', '.join(self.contenders)}; {trials} trials)"

    def to_pandas(self) -> Any:
        """Return statistics as a pandas.DataFrame, a row per metric, variant and group; needs pandas."""
        require_pandas()
        from pandas import DataFrame

        rows = [
            {"metric": metric, "variant": row.variant, "group": row.group, **asdict(values)}
            for row in summary_rows(self.summary)
            for metric, values in row.entry.metrics.items()
        ]
        return DataFrame(rows)

    def document(self) -> Document:
        """Return a document with verdicts, differences, distributions, simulations over time, tables and provenance."""
        folders = [batch.folder for batch in self.batches.values()]
        command = write_command(COMPARE, {"results": folders}, {"reference": self.reference})
        return comparison_document(self, command, self.displayed)

    def plot(self, *metrics: str) -> Plot:
        """Plot distributions of metrics over successful trials of every variant; by default all metrics that vary.

        Raises KeyError for an unknown metric, ValueError if there is nothing to plot.
        """
        from ..documents.of.comparison.variant_distributions import (
            looks_of,
            metric_distributions,
            metric_figures,
            sort_metrics,
        )
        from ..documents.render.notebook import plot_figures

        known = {metric.name: metric for metric in self.metrics}
        for name in metrics:
            if name not in known:
                raise KeyError(f"no metric {name}; {suggestion(name, known)}")
        distributions = metric_distributions(self)
        sampled = [known[name] for name in metrics] or sort_metrics(distributions)[0]
        if not sampled:
            raise ValueError("no metric varies and has a finite value")
        return plot_figures(metric_figures(distributions, sampled, looks_of(self)), list(self.contenders))


@verb(COMPARE)
def compare(*results: FilePath | Sequence[FilePath], **options: Unpack[CompareOptions]) -> Comparison:
    """Compare variants of stored campaigns side by side: `perilune compare`.

    ``results`` are folders that `batch` wrote to its ``output``, as arguments or a list; the samples of all campaigns
    must be the same. Raises InputError.
    """
    folders = [Path(folder) for folder in path_list(results)]
    if not folders:
        raise InputError("compare", "", "no results folder is given", "give folders that batch(..., output=...) wrote")
    compared = compare_folders(Comparison, folders, options["reference"])
    compared.text(options["metrics"])  # rejects unknown names
    return replace(compared, displayed=tuple(options["metrics"]))
