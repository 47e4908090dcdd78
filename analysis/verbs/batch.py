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
from ..campaigns.execute import campaign_result
from ..campaigns.execute.cluster.connection import cluster
from ..campaigns.execute.loaded_campaign import open_campaign
from ..campaigns.execute.runner import fly_campaign
from ..campaigns.summary_text import select_metrics
from ..documents.model import Document
from ..documents.of.batch.batch import batch_document
from ..documents.of.batch.printed import campaign_problems
from ..options.declared.campaigns import BATCH, BatchOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.flight.results import require_pandas
from ..studies.sobol import rank_correlations
from ..traceability.campaign_task import write_task
from .common.campaign_options import campaign_requirements, read_campaign, resume_hint, warn_of_foreign_fmus
from .common.documented import Documented

if TYPE_CHECKING:  # imported where needed: matplotlib is slow to import
    from matplotlib.figure import Figure as Plot


@dataclass(repr=False)
class BatchResult(Documented, campaign_result.CampaignResult):
    """Result of a campaign: ``summary`` contains rates and statistics by variant, ``trials`` numbers by trial.

    ``requirements`` are the expressions of the option ``require``, and ``displayed`` are the metrics of the option
    ``metrics``.
    """

    requirements: tuple[Expression, ...] = ()
    displayed: tuple[str, ...] = ()

    def __repr__(self) -> str:
        rates = ", ".join(f"{name} {short_percent(entry.success_rate)} %" for name, entry in self.summary.items())
        return f"{type(self).__name__}({self.provenance['system']}, {self.plan.campaign.trials} trials: {rates})"

    def document(self) -> Document:
        """Return a document with verdicts on the variants, distributions, recorded simulations and failures."""
        return batch_document(self, self.displayed)

    def problems(self) -> list[str]:
        """Return a line for each kind of failed simulations, and for each requirement that is not met."""
        return campaign_problems(self, self.requirements)

    def to_pandas(self) -> Any:
        """Return `table` as a pandas.DataFrame, a row per variant and trial; needs pandas."""
        require_pandas()
        return self.table().to_pandas()

    def rank_correlations(self, variant: str | None = None) -> dict[str, dict[str, float | None]]:
        """Return Spearman's rank correlation of each metric with each sampled input, by metric and input.

        ``variant`` is by default the first one. Trials in which the metric is not a number are left out; a correlation
        is None if too few trials remain or a column is constant. Raises KeyError for an unknown variant.
        """
        rows = next(iter(self.rows.values())) if variant is None else self.rows[variant]
        campaign = self.plan.campaign
        draws = {name: rows.column(f"draw.{name}") for name in campaign.input_names()}
        metrics = {metric.name: rows.column(f"metric.{metric.name}") for metric in campaign.metrics}
        return rank_correlations(draws, metrics)

    def write(self, folder: FilePath) -> None:
        """Write the files of `perilune batch --output`: trials, samples, summary, and recorded traces."""
        super().write(Path(folder))

    def write_task(self, path: FilePath) -> None:
        """Write the simulation task of `perilune batch --trace`. Raises InputError without ``output``."""
        if self.folder is None:
            raise InputError("`trace`", str(path), "the batch has no folder with files to describe", "give `output`")
        write_task(self, Path(path))

    def plot(self, *metrics: str) -> Plot:
        """Plot distributions of metrics over trials, variants side by side; by default all metrics that vary.

        At most the first 100 000 trials are plotted. Raises KeyError for an unknown metric, ValueError if there is
        nothing to plot.
        """
        from ..documents.of.campaign.distributions import metric_plot, sort_metrics

        known = {metric.name: metric for metric in self.plan.campaign.metrics}
        for name in metrics:
            if name not in known:
                raise KeyError(f"no metric {name}; {suggestion(name, known)}")
        selected = [known[name] for name in metrics] or sort_metrics(self)[0]
        if not selected:
            raise ValueError(f"{self.plan.campaign.file}: no metric varies and has a finite value")
        return metric_plot(self, selected)


@verb(BATCH)
def batch(system: FilePath, campaign: FilePath, **options: Unpack[BatchOptions]) -> BatchResult:
    """Simulate a campaign of a system, a name or the path of a .toml file: `perilune batch`.

    All variants, and all FMUs in ``compare``, are simulated with the same samples. A folder ``output`` that contains
    results is an error unless ``overwrite`` or ``resume`` is set. ``faults`` are injected in every trial, after the
    faults of the campaign, and every trial has the same ``input``. A trial that exceeds ``timeout`` (s, wall clock)
    ends as ``timed_out`` and is not a success; the campaign continues. In ``set`` a text "low:high:step" is a sweep.
    ``require`` lists expressions over numbers of the summary; see `BatchResult.problems`. Raises InputError.
    """
    folder = None if options["output"] is None else Path(options["output"])
    if options["resume"] and folder is None:
        raise InputError("`resume`", "", "no folder to resume", "give `output`")
    if options["resume"] and options["overwrite"]:
        raise InputError(
            "`resume`",
            "`overwrite`",
            "one keeps the stored results, the other overwrites them",
            "leave out `resume` or `overwrite`",
        )
    if options["retry_crashed"] and not options["resume"]:
        raise InputError("`retry_crashed`", "", "no stored trials to simulate again", "give `resume`")
    is_kept = options["overwrite"] or options["resume"]
    check_folder("`output`", folder, overwrite=is_kept, otherwise="`resume` or `overwrite`")
    plan = read_campaign(system, campaign, options)
    requirements = campaign_requirements(plan, options["require"])
    select_metrics(options["metrics"], [metric.name for metric in plan.campaign.metrics], ())  # before any simulation
    workers, engine = options["workers"], options["engine"]
    with (
        chdir(Path.cwd()),  # an FMU may change the folder
        resume_hint(folder),
        cluster(options["scheduler"], workers=workers, engine=engine) as elsewhere,
    ):
        by = None if options["scheduler"] is None else "the scheduler's workers"
        opened = open_campaign(plan, folder, resume=options["resume"], engine=engine, workers=workers, elsewhere=by)
        if options["resume"]:
            warn_of_foreign_fmus(opened)
        if options["retry_crashed"]:
            opened.discard_lost(range(opened.numbering.count))
        rows = fly_campaign(opened, opened.missing(), workers=workers, engine=engine, elsewhere=elsewhere)
        displayed = tuple(options["metrics"])
        return BatchResult.finish(opened, rows, requirements=tuple(requirements), displayed=displayed)
