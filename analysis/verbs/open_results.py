"""Stored campaigns in Python: `open_results`, and `plot_results` for several of them in one figure."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow.compute

from ...common.errors import InputError, suggestion
from ..campaigns.definition.campaign import Metric
from ..campaigns.definition.expressions import Expression
from ..campaigns.execute.campaign_result import CampaignResult
from ..campaigns.execute.loaded_campaign import read_folder
from ..campaigns.folder.opened import OpenedResults
from ..documents.common.colours import look
from ..documents.of.campaign.distributions import distribution_plot
from ..documents.of.campaign.stored import stored_document
from ..options.option import FilePath
from ..runtime.flight.results import require_pandas

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Plot

Results = OpenedResults | CampaignResult


def plot_results(results: Mapping[str, FilePath | Results], metrics: Sequence[str] | None = None) -> Plot:
    """Plot distributions of metrics of several campaigns over all trials: a panel per metric, a line per variant.

    ``results`` maps labels to folders of `batch`, or to results of `batch` or `open_results`. The campaigns may differ
    in system and samples; only names and units of metrics must agree. By default all common metrics that vary are
    plotted. Raises KeyError for an unknown metric, InputError for different units and other folders, ValueError if
    there is nothing to plot.
    """
    if not results:
        raise InputError("plot_results", "", "no results", "give folders that batch(..., output=...) wrote, by labels")
    opened = {
        label: OpenedResults(read_folder(Path(source))) if isinstance(source, str | os.PathLike) else source
        for label, source in results.items()
    }
    return distributions(opened, metrics)


def distributions(results: Mapping[str, Results], metrics: Sequence[str] | None) -> Plot:
    """Return the figure of `plot_results`; the label of a single campaign may be empty."""
    declared = {label: _metrics(batch) for label, batch in results.items()}
    common = [name for name in next(iter(declared.values())) if all(name in batch for batch in declared.values())]
    for name in metrics or ():
        for label, known in declared.items():
            if name not in known:
                raise KeyError(f"no metric {name}{f' in {label}' if label else ''}; {suggestion(name, known)}")
    displayed: dict[Metric, dict[str, np.ndarray]] = {}
    for name in common if metrics is None else dict.fromkeys(metrics):
        metric = _of_one_unit(name, declared)
        values = {line: column for label, batch in results.items() for line, column in _lines(label, batch, name)}
        whole = np.concatenate(list(values.values()))
        if _varies(whole) or (metrics is not None and np.isfinite(whole).any()):
            displayed[metric] = values
    if not displayed:
        raise ValueError(
            f"{', '.join(filter(None, results)) or 'the campaign'}: no metric varies and has a finite value"
        )
    lines = list(dict.fromkeys(line for values in displayed.values() for line in values))
    return distribution_plot(displayed, {line: look(index) for index, line in enumerate(lines)})


def _metrics(results: Results) -> dict[str, Metric]:
    if isinstance(results, CampaignResult):
        return {metric.name: metric for metric in results.plan.campaign.metrics}
    facts = results.provenance["metrics"]
    return {
        name: Metric(name, Expression(fact["expression"]), fact["reduction"], unit=fact["unit"])
        for name, fact in facts.items()
    }


def _of_one_unit(name: str, declared: Mapping[str, Mapping[str, Metric]]) -> Metric:
    """Return a metric that all campaigns have. Raises InputError if its units differ."""
    (first, metric), *others = ((label, known[name]) for label, known in declared.items())
    for label, other in others:
        if other.unit != metric.unit:
            problem = f"its unit is {other.unit}, but {metric.unit} in {first}"
            raise InputError(label, f"metric {name}", problem, "name metrics that have the same unit in all folders")
    return metric


def _lines(label: str, results: Results, metric: str) -> list[tuple[str, np.ndarray]]:
    """Return the values of a metric by the name of the line: the label, the variant, or both."""
    if isinstance(results, CampaignResult):
        lines = {variant: rows.column(f"metric.{metric}") for variant, rows in results.rows.items()}
    else:
        table = results.arrow(["variant", f"metric.{metric}"])
        column = table.column(1).to_numpy().astype(np.float64)
        lines = {
            variant: column[pyarrow.compute.equal(table.column(0), variant).to_numpy()] for variant in results.variants
        }
    if not label:
        return list(lines.items())
    return [(label if len(lines) == 1 else f"{label}: {variant}", values) for variant, values in lines.items()]


def _varies(values: np.ndarray) -> bool:
    finite = values[np.isfinite(values)]
    return bool(finite.size) and not (finite.size == values.size > 1 and np.all(finite == finite[0]))


class StoredResults(OpenedResults):
    """A campaign's folder as of its opening; data are read when they are requested.

    ``columns`` are units and descriptions by name, ``trials`` is the number of trials per variant, ``flown`` is the
    number of stored trials per variant, and ``provenance`` lists what the numbers depend on.
    """

    def __repr__(self) -> str:
        there = f"{self.flown} of {self.trials}" if self.flown < self.trials else f"{self.trials}"
        return f"{type(self).__name__}({self.provenance['system']}, {there} trials: {', '.join(self.variants)})"

    def to_pandas(self, columns: Sequence[str] | None = None) -> Any:
        """Return ``columns`` (default: all) as a pandas.DataFrame, a row per variant and trial; needs pandas."""
        require_pandas()
        return self.arrow(columns).to_pandas()

    def plot(self, *metrics: str) -> Plot:
        """Plot distributions of metrics over all trials, variants side by side; by default all metrics that vary.

        Raises KeyError for an unknown metric, ValueError if there is nothing to plot.
        """
        return distributions({"": self}, metrics or None)

    def _repr_html_(self) -> str:
        from ..documents.render.notebook import document_view

        return document_view(stored_document(self))


def open_results(folder: FilePath) -> StoredResults:
    """Open a folder that `batch` wrote to its ``output``, complete or unfinished, without reading trials.

    An unfinished campaign has the trials stored so far; open it again for more. Raises InputError for any other folder.
    Damaged shards, and shards of another campaign, raise InputError when they are read.
    """
    return StoredResults(read_folder(Path(folder)))
