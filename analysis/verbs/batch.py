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
from ..campaigns.summary_text import select_metrics
from ..documents.model import Document
from ..documents.of.batch.batch import batch_document
from ..options.declared.campaigns import BATCH, BatchOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.flight.results import require_pandas
from ..studies.sobol import rank_correlations
from ..traceability.campaign_task import write_task
from .common.campaign_text import campaign_problems, campaign_requirements
from .common.campaigns import name_foreign, read_campaign, resume_hint
from .common.documented import Documented

if TYPE_CHECKING:  # plots and pages are imported where they are created
    from matplotlib.figure import Figure as Plot


@dataclass(repr=False)
class BatchResult(Documented, results.BatchResult):
    """All trials of all variants; ``summary`` has rates and statistics by variant, ``trials`` the numbers behind.

    ``requirements`` are those of the option ``require``, ``displayed`` the metrics of the option ``metrics``.
    """

    requirements: tuple[Expression, ...] = ()
    displayed: tuple[str, ...] = ()

    def __repr__(self) -> str:
        rates = ", ".join(f"{name} {short_percent(entry.success_rate)} %" for name, entry in self.summary.items())
        return f"{type(self).__name__}({self.provenance['system']}, {self.plan.campaign.trials} trials: {rates})"

    def document(self) -> Document:
        """Return the batch with verdicts on its variants, distributions, recorded simulations and failures."""
        return batch_document(self, self.displayed)

    def problems(self) -> list[str]:
        """Return failed simulations and requirements of the campaign and of ``require`` that are not met."""
        return campaign_problems(self, self.requirements)

    def to_pandas(self) -> Any:
        """Return `table` as a pandas.DataFrame, a row per variant and trial; needs pandas."""
        require_pandas()
        return self.table().to_pandas()

    def rank_correlations(self, variant: str | None = None) -> dict[str, dict[str, float | None]]:
        """Return Spearman's rank correlations of a variant's metrics with the draws, by metric and draw.

        By default of the first variant. Over all trials in which the metric is a number; None where there are too few,
        or one of the two does not vary. Raises KeyError for a variant that the batch does not have.
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

    def plot(self, *metrics: str) -> Plot:
        """Plot distributions of metrics over trials, variant next to variant; by default all metrics that vary.

        Of more than 100 000 trials the first are plotted.

        Raises KeyError for a metric that the campaign does not have, and ValueError where there is none to plot.
        """
        from ..documents.of.campaign.distributions import metric_plot, sort_metrics

        known = {metric.name: metric for metric in self.plan.campaign.metrics}
        for name in metrics:
            if name not in known:
                raise KeyError(f"no metric {name}; {suggestion(name, known)}")
        selected = [known[name] for name in metrics] or sort_metrics(self)[0]
        if not selected:
            raise ValueError(f"{self.plan.campaign.file}: no metric that varies and is finite anywhere")
        return metric_plot(self, selected)


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
