"""`perilune.batch`: a campaign of many trials; its result with page, plots and tables."""

from __future__ import annotations

from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from ...common.errors import InputError, suggestion
from ...common.percent import short_percent
from ...common.targets import check_folder
from ..campaigns.definition.expressions import Expression
from ..campaigns.execute import results
from ..campaigns.execute.campaign import open_campaign
from ..campaigns.execute.cluster.connection import cluster
from ..campaigns.execute.runner import fly_campaign
from ..campaigns.summary import CONFIDENCE, summary_rows
from ..campaigns.summary_text import select_metrics
from ..campaigns.tables import requirement_rows, who_cells, who_heads
from ..options.declared.campaigns import BATCH, BatchOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.flight.results import require_pandas
from ..studies.sobol import rank_correlations
from ..traceability.campaign_task import write_task
from .common.campaign_text import campaign_problems, campaign_requirements, status_meanings, worst_lines
from .common.campaigns import name_foreign, read_campaign, resume_hint

if TYPE_CHECKING:  # plots and pages are imported where they are made
    from matplotlib.figure import Figure as Plot

    from ..reports.common.notebook import Grid

MOST_PLOTTED = 6  # metrics, in a notebook


@dataclass(repr=False)
class BatchResult(results.BatchResult):
    """All trials of all variants; ``summary`` has rates and statistics by variant, ``trials`` the numbers behind.

    ``requirements`` are those of the option ``require``, ``displayed`` the metrics of the option ``metrics``.
    """

    requirements: tuple[Expression, ...] = ()
    displayed: tuple[str, ...] = ()

    def __repr__(self) -> str:
        rates = ", ".join(f"{name} {short_percent(entry.success_rate)} %" for name, entry in self.summary.items())
        return f"{type(self).__name__}({self.provenance['system']}, {self.plan.campaign.trials} trials: {rates})"

    def to_json(self) -> dict[str, object]:
        """Provenance and the summary of each variant."""
        return self.content()

    def lines(self) -> list[str]:
        """What `perilune batch` prints."""
        return [self.text(self.displayed), *worst_lines(self), *status_meanings(self.plan, self)]

    def problems(self) -> list[str]:
        """Failed simulations, requirements of the campaign and of ``require`` that are not met."""
        return campaign_problems(self, self.requirements)

    def to_pandas(self) -> Any:
        """`table` as a pandas.DataFrame, a row per variant and trial; needs pandas."""
        require_pandas()
        return self.table().to_pandas()

    def rank_correlations(self, variant: str | None = None) -> dict[str, dict[str, float | None]]:
        """Spearman's rank correlations of one variant's metrics with the draws, by metric and draw; of the first one.

        Over all trials in which the metric is a number; None where there are too few, or one of the two does not vary.
        Raises KeyError for a variant that the batch does not have.
        """
        rows = next(iter(self.rows.values())) if variant is None else self.rows[variant]
        campaign = self.plan.campaign
        draws = {name: rows.column(f"draw.{name}") for name in campaign.input_names()}
        metrics = {metric.name: rows.column(f"metric.{metric.name}") for metric in campaign.metrics}
        return rank_correlations(draws, metrics)

    def write(self, folder: FilePath) -> None:
        """Write what `perilune batch --output` does: trials, draws, summary, traces where the campaign keeps them."""
        super().write(Path(folder))

    def write_task(self, path: FilePath) -> None:
        """Write the simulation task of `perilune batch --trace`, of a batch with ``output``. Raises InputError."""
        if self.folder is None:
            raise InputError("`trace`", str(path), "the batch has no folder, whose files it describes", "give `output`")
        write_task(self, Path(path))

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune batch --report`: one HTML file."""
        from ..reports.campaign.batch_report import write_batch_report

        write_batch_report(self, Path(path), self.provenance["system"])

    def plot(self, *metrics: str) -> Plot:
        """Distributions of metrics over trials, variant next to variant; by default of all metrics that vary.

        Of more than 100 000 trials the first are plotted.

        Raises KeyError for a metric that the campaign does not have, and ValueError where there is none to plot.
        """
        from ..reports.campaign.distributions import metric_plot, sort_metrics

        known = {metric.name: metric for metric in self.plan.campaign.metrics}
        for name in metrics:
            if name not in known:
                raise KeyError(f"no metric {name}; {suggestion(name, known)}")
        selected = [known[name] for name in metrics] or sort_metrics(self)[0]
        if not selected:
            raise ValueError(f"{self.plan.campaign.file}: no metric that varies and is finite anywhere")
        return metric_plot(self, selected)

    def _repr_html_(self) -> str:
        from ..reports.campaign.distributions import metric_plot, sort_metrics
        from ..reports.common.notebook import Grid, metric_grid, notebook_view

        group, rows = self.plan.campaign.group, summary_rows(self.summary)
        head = (*who_heads(group), "trials", "success, %", f"{100 * CONFIDENCE:g} % interval", "statuses")
        rates = [
            (
                *who_cells(row, group),
                str(row.entry.trials),
                short_percent(row.entry.success_rate),
                " to ".join(short_percent(end) for end in row.entry.success_interval),
                ", ".join(f"{count} {status}" for status, count in row.entry.statuses.items()),
            )
            for row in rows
        ]
        selected = sort_metrics(self)[0][:MOST_PLOTTED]
        plot = metric_plot(self, selected) if selected else None
        faults = self.plan.fault_texts()
        text = [Path(self.plan.campaign.file).name, f"with faults: {'; '.join(faults)}" if faults else ""]
        metrics = [metric.name for metric in self.plan.campaign.metrics]
        grids = [Grid(head, rates), self._requirement_grid(), metric_grid(rows, metrics, group)]
        return notebook_view(self.provenance["system"], text, grids, plot)

    def _requirement_grid(self) -> Grid:
        from ..reports.common.notebook import Grid

        rows = [
            (f"{name}: {entry.text}", variant, entry.verdict, str(entry.flights), str(entry.failures))
            for variant, name, entry in requirement_rows(self.summary)
        ]
        return Grid(("requirement", "variant", "verdict", "flights", "failures"), rows)


@verb(BATCH)
def batch(system: FilePath, campaign: FilePath, **options: Unpack[BatchOptions]) -> BatchResult:
    """Simulate a campaign, by name or path of its .toml file: `perilune batch`.

    ``compare`` maps slots to the FMUs compared there on the same draws, one or a list; ``output`` is a folder for
    trials, draws and summary, refused if it holds results unless ``overwrite``, or ``resume``, which continues with
    what it holds, and with ``retry_crashed`` simulates shards again that have trials which crashed, hung or ran out of
    memory; ``until_decided`` ends with the first shard after which the campaign's requirements are met, or are
    not; ``engine`` is threads or processes, and ``scheduler`` the address of a dask scheduler whose workers simulate
    instead; ``faults`` are injected in every trial, after the campaign's own, and every trial has the same ``input``;
    one that takes longer than ``timeout`` (s, wall clock) ends ``timed_out``, is no success, and the next one starts;
    ``draws`` is a Parquet file of given draws, one row a trial. In ``set`` a text "low:high:step" is a sweep.
    ``require`` are expressions over the summary's numbers, see `BatchResult.problems`; ``metrics`` are those that the
    command line prints. The rest is as in `simulate`.
    Raises InputError.
    """
    folder = None if options["output"] is None else Path(options["output"])
    if options["resume"] and folder is None:
        raise InputError("`resume`", "", "there is no folder to resume in", "give `output`")
    if options["resume"] and options["overwrite"]:
        raise InputError("`resume`", "`overwrite`", "one keeps what is stored, one does not", "leave one of them out")
    if options["retry_crashed"] and not options["resume"]:
        raise InputError("`retry_crashed`", "", "there are no trials to simulate again", "give `resume`")
    is_kept = options["overwrite"] or options["resume"]
    check_folder("`output`", folder, overwrite=is_kept, otherwise="`resume` or `overwrite`")
    plan = read_campaign(system, campaign, options)
    requirements = campaign_requirements(plan, options["require"])
    select_metrics(options["metrics"], [metric.name for metric in plan.campaign.metrics], ())  # refused before flights
    workers, engine = options["workers"], options["engine"]
    with (
        chdir(Path.cwd()),  # an FMU may change the folder
        resume_hint(folder),
        cluster(options["scheduler"], workers=workers, engine=engine) as elsewhere,
    ):
        by = None if options["scheduler"] is None else "the scheduler's workers"
        opened = open_campaign(plan, folder, resume=options["resume"], engine=engine, workers=workers, elsewhere=by)
        if options["resume"]:
            name_foreign(opened)
        if options["retry_crashed"]:
            opened.discard_lost(range(opened.numbering.count))
        rows = fly_campaign(opened, opened.missing(), workers=workers, engine=engine, elsewhere=elsewhere)
        displayed = tuple(options["metrics"])
        return BatchResult.finish(opened, rows, requirements=tuple(requirements), displayed=displayed)
