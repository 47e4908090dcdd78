"""A campaign from Python: `batch`, and its result with page, plots and tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from matplotlib.figure import Figure as Plot

from ..campaigns.draws.declared import drawn_names
from ..campaigns.fly import results, runner
from ..campaigns.fly.cluster.connection import cluster
from ..campaigns.rows import whole_column
from ..campaigns.spec.plan import read_plan
from ..campaigns.spec.sweeps import part_sweeps
from ..campaigns.summary import CONFIDENCE, summary_rows
from ..campaigns.tables import requirement_rows, who_cells, who_heads
from ..common.errors import InputError, suggestion
from ..common.percent import short_percent
from ..common.targets import check_folder
from ..reports.campaign.batch_report import write_batch_report
from ..reports.campaign.distributions import metric_plot, sort_metrics
from ..reports.common.notebook import Grid, metric_grid, notebook_view
from ..runtime.flight.results import require_pandas
from ..runtime.ssp.parameter_sets import SetValue
from ..runtime.system.fault import Fault, faults_of
from ..runtime.system.in_flight.series import Given, read_series
from ..runtime.system.in_flight.watch import Watch
from ..studies.sensitivity.ranks import rank_correlations
from .options import Compared, FilePath, check_list, compared, system_options

MOST_PLOTTED = 6  # metrics, in a notebook


@dataclass(repr=False)
class BatchResult(results.BatchResult):
    """All trials of all variants; ``summary`` has rates and statistics by variant, ``trials`` the numbers behind."""

    def __repr__(self) -> str:
        rates = ", ".join(f"{name} {short_percent(found['success_rate'])} %" for name, found in self.summary.items())
        return f"{type(self).__name__}({self.provenance['system']}, {self.plan.campaign.trials} trials: {rates})"

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
        draws = {name: whole_column(rows, f"draw.{name}") for name in drawn_names(campaign)}
        metrics = {metric.name: whole_column(rows, f"metric.{metric.name}") for metric in campaign.metrics}
        return rank_correlations(draws, metrics)

    def write(self, folder: FilePath) -> None:
        """Write what `perilune batch --output` does: trials, draws, summary, traces where the campaign keeps them."""
        super().write(Path(folder))

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune batch --report`: one HTML file."""
        write_batch_report(self, Path(path), self.provenance["system"])

    def plot(self, *metrics: str) -> Plot:
        """How metrics are distributed over trials, variant beside variant; of none named all that vary.

        Of more than 100 000 trials the first are drawn.

        Raises KeyError for a metric that the campaign does not have, and ValueError where there is none to draw.
        """
        known = {metric.name: metric for metric in self.plan.campaign.metrics}
        for name in metrics:
            if name not in known:
                raise KeyError(f"no metric {name}; {suggestion(name, known)}")
        drawn = [known[name] for name in metrics] or sort_metrics(self)[0]
        if not drawn:
            raise ValueError(f"{self.plan.campaign.file}: no metric that varies and is finite anywhere")
        return metric_plot(self, drawn)

    def _repr_html_(self) -> str:
        group, rows = self.plan.campaign.group, summary_rows(self.summary)
        head = (*who_heads(group), "trials", "success, %", f"{100 * CONFIDENCE:g} % interval", "statuses")
        rates = [
            (
                *who_cells(row, group),
                str(row.entry["trials"]),
                short_percent(row.entry["success_rate"]),
                " to ".join(short_percent(end) for end in row.entry["success_interval"]),
                ", ".join(f"{count} {status}" for status, count in row.entry["statuses"].items()),
            )
            for row in rows
        ]
        drawn = sort_metrics(self)[0][:MOST_PLOTTED]
        plot = metric_plot(self, drawn) if drawn else None
        faults = self.plan.fault_texts()
        words = [Path(self.plan.campaign.file).name, f"with faults: {'; '.join(faults)}" if faults else ""]
        metrics = [metric.name for metric in self.plan.campaign.metrics]
        grids = [Grid(head, rates), self._requirement_grid(), metric_grid(rows, metrics, group)]
        return notebook_view(self.provenance["system"], words, grids, plot)

    def _requirement_grid(self) -> Grid:
        rows = [
            (f"{name}: {found['text']}", variant, found["verdict"], str(found["flights"]), str(found["failures"]))
            for variant, name, found in requirement_rows(self.summary)
        ]
        return Grid(("requirement", "variant", "verdict", "flights", "failures"), rows)


def batch(
    system: FilePath,
    campaign: FilePath,
    *,
    compare: Compared | None = None,
    trials: int | None = None,
    seed: int | None = None,
    workers: int | None = None,
    output: FilePath | None = None,
    overwrite: bool = False,
    resume: bool = False,
    until_decided: bool = False,
    engine: Literal["threads", "processes"] | None = None,
    scheduler: str | None = None,
    use: Mapping[str, FilePath] | None = None,
    parameters: Sequence[FilePath] = (),
    set: Mapping[str, SetValue] | None = None,
    faults: Sequence[Fault | str] = (),
    input: Given | None = None,
    draws: FilePath | None = None,
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
) -> BatchResult:
    """Fly a campaign, by name or path of its .toml file: `perilune batch`.

    ``compare`` maps slots to the FMUs flown there on the same draws, one or a list; ``output`` is a folder for
    trials, draws and summary, refused if it holds results unless ``overwrite``, or ``resume``, which goes on with
    what it holds; ``until_decided`` ends with the first shard after which the campaign's requirements are met, or
    are not; ``engine`` is what flies side by side, threads or processes, and ``scheduler`` the address of a dask
    scheduler whose workers fly instead; ``faults`` fly in every trial, after the campaign's own, and every trial
    has the same ``input``; one that takes longer than ``timeout`` (s, wall clock) ends ``timed_out``, is no
    success, and the next one flies; ``draws`` is a Parquet file of draws to fly, a trial for each row. In ``set`` a
    text "low:high:step" is a sweep. The rest is as in `simulate`. Raises InputError.
    """
    folder = Path(output) if output is not None else None
    if resume and folder is None:
        raise InputError("resume", "", "there is no folder to go on in", "give output")
    check_folder("output", folder, overwrite=overwrite or resume, otherwise="resume or overwrite")
    options = system_options(
        use, parameters, set, feedthrough, no_feedthrough, step=step, stop_time=stop_time, algorithm=algorithm,
        variant=variant, flavour=flavour, allow_unmatched=allow_unmatched, strict=strict, open_inputs=open_inputs,
    )  # fmt: skip
    check_list("faults", faults)
    options, sweeps = part_sweeps(options)
    plan = read_plan(
        Path(system), str(campaign), options, trials=trials, seed=seed, compare=compared(compare),
        faults=faults_of(faults), series=None if input is None else read_series(input), watch=Watch(timeout, log),
        until_decided=until_decided,
        draws=None if draws is None else Path(draws),
        sweeps=sweeps,
    )  # fmt: skip
    with (
        chdir(Path.cwd()),  # an FMU may change the folder
        cluster(scheduler, workers=workers, engine=engine) as elsewhere,
    ):
        flown = runner.run_batch(
            plan, workers=workers, output=folder, resume=resume, engine=engine, elsewhere=elsewhere
        )
        return _told(flown)


def shard(
    folder: FilePath,
    numbers: Sequence[int],
    *,
    workers: int | None = None,
    engine: Literal["threads", "processes"] | None = None,
    scheduler: str | None = None,
) -> None:
    """Fly some shards of a campaign whose folder is there: `perilune shard`. Those that are flown stay as they are.

    ``scheduler`` is as in `batch`. Raises InputError, for a number that is no shard's too.
    """
    campaign = runner.open_folder(Path(folder))
    wanted = campaign.checked(numbers)
    with chdir(Path.cwd()), cluster(scheduler, workers=workers, engine=engine) as elsewhere:
        runner.fly_campaign(campaign, wanted, workers=workers, engine=engine, elsewhere=elsewhere)


def merge(folder: FilePath) -> BatchResult:
    """Put the shards of a campaign's folder together: `perilune merge`. Raises InputError where some are missing."""
    with chdir(Path.cwd()):
        return _told(runner.merge(runner.open_folder(Path(folder))))


def _told(flown: results.BatchResult) -> BatchResult:
    """A result with what Python users have of it."""
    return BatchResult(flown.plan, flown.rows, flown.summary, flown.provenance, flown.folder)
