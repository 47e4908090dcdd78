"""Plan of a campaign: system, options, draws and variants, checked before any simulation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from ....common.errors import InputError
from ....fmus_src.roles import SEED, STREAM
from ...options.fault import Fault
from ...runtime.ssp.archive import SystemArchive, open_system
from ...runtime.system.options import UNWATCHED, SystemOptions, Watch
from ...runtime.system.passing.flight_table import FlightTable
from ...runtime.system.prepared import PreparedSystem, prepare_system
from ...runtime.system.series import InputSeries
from ..draws.generators import stream_numbers
from ..draws.supplied import SuppliedDraws, read_supplied
from ..draws.table import CountedDraws, Draws, DrawTable, draw_parts, draw_table, split_trials, table_of
from .campaign import Campaign, TrialGroup, Variant, groups_of
from .campaign_source import CampaignSource, read_source
from .faults import DrawnFault, fault_columns, fault_of_trials
from .file import parse_campaign
from .home import is_called
from .sweeps import with_sweeps


@dataclass(frozen=True)
class TrialSamples:
    """Samples of the trials ``numbers`` of a plan.

    ``supplied`` samples replace drawn ones; ``user_faults`` are the faults from the command line.
    """

    campaign: Campaign
    supplied: SuppliedDraws | None
    user_faults: Sequence[Fault]
    numbers: range
    table: DrawTable
    faults: Sequence[DrawnFault]

    def columns_of(self, trials: range) -> dict[str, np.ndarray]:
        """Return, by name, all drawn and derived values of some of these trials."""
        rows = self._rows(trials)
        return {name: column[rows] for name, column in self.table.columns.items()}

    def faults_of(self, trial: int) -> list[Fault | None]:
        """Return the faults of a trial, in the order of `BatchPlan.list_faults`; None for faults that do not act."""
        return [*(fault.in_trial(trial - self.numbers.start) for fault in self.faults), *self.user_faults]

    def parameters(self, prepared: PreparedSystem, trial: int) -> dict[str, float | int]:
        """Return the parameters of a trial: draws, and the seed and stream of every component that has them."""
        columns = self._columns(prepared, range(trial, trial + 1))
        return {name: column.item() for name, column in columns.items()}

    def flights(self, prepared: PreparedSystem, trials: range) -> FlightTable:
        """Return the inputs of some of these trials, with faults in the order of `BatchPlan.list_faults`."""
        rows = self._rows(trials)
        drawn = [fault.columns_of(rows) for fault in self.faults]
        fault_samples = [fault_columns(fault, len(trials)) for fault in self.user_faults]
        return FlightTable(len(trials), self._columns(prepared, trials), [*drawn, *fault_samples])

    def _columns(self, prepared: PreparedSystem, trials: range) -> dict[str, np.ndarray]:
        columns = self.table.parameters(self._rows(trials))
        campaign, fmus = self.campaign, prepared.network.fmus
        for name in with_streams(prepared):
            mine = (
                np.arange(trials.start, trials.stop)
                if self.supplied is None
                else self.supplied.streams_of(trials, name)
            )
            seed, streams = stream_numbers(campaign.seed, mine, name, fmus, campaign.file)
            columns[f"{name}.{SEED}"], columns[f"{name}.{STREAM}"] = np.full(len(trials), seed), streams
        return columns

    def _rows(self, trials: range) -> slice:
        return slice(trials.start - self.numbers.start, trials.stop - self.numbers.start)


def with_streams(prepared: PreparedSystem) -> list[str]:
    """Return the names of the components that generate random numbers."""
    return [name for name, fmu in prepared.network.fmus.items() if {SEED, STREAM} <= fmu.variables.keys()]


PART = 32768  # trials whose draws are checked together, which bounds memory


@dataclass(frozen=True)
class BatchPlan:
    """Complete definition of a batch, small enough to be sent to every worker.

    ``options`` are the user's system options, which override the campaign's; draws override parameter sets.
    ``campaign_sha256`` is the digest of the campaign's file. ``overlaid`` parameters are set in every simulation by the
    executor of the plan. ``faults`` are the user's, applied in every trial after the campaign's; ``series`` are the
    inputs over time of all trials; ``watch`` supervises each simulation. ``supplied`` samples replace drawn ones.
    """

    system: str
    campaign: Campaign
    options: SystemOptions
    campaign_sha256: str = ""
    overlaid: tuple[str, ...] = ()
    faults: tuple[Fault, ...] = ()
    series: InputSeries | None = None
    watch: Watch = UNWATCHED
    supplied: SuppliedDraws | None = None
    compared_by: str = ""  # origin of the compared FMUs in errors: --compare, or the campaign's file
    source: CampaignSource | None = None  # the campaign's file, with the files that it extends
    until_decided: bool = False  # True if the batch ends as soon as the campaign's requirements are decided
    archive: SystemArchive | None = None  # simulated instead of the system named by `system`
    known_draws: Draws | None = field(default=None, compare=False, repr=False)  # draws of all trials, if already known

    @cached_property
    def draws(self) -> Draws:
        """Samples of all trials. Raises InputError."""
        if self.known_draws is not None:
            return self.known_draws
        if self.supplied is not None:
            return table_of(self.campaign, self.supplied.table)
        return CountedDraws(self.campaign) if self.is_counted else draw_table(self.campaign)

    @property
    def is_counted(self) -> bool:
        """True if samples are drawn separately for each block of trials, without a table."""
        return self.supplied is None and self.campaign.draw_scheme == "counter"

    def draw_parts(self, size: int = PART) -> Iterator[DrawTable]:
        """Yield the samples of all trials in blocks of ``size``, without storing them in memory. Raises InputError."""
        if self.supplied is None and not self.is_counted and self.known_draws is None:
            yield from draw_parts(self.campaign, size)
            return
        for part in split_trials(self.campaign.trials, size):
            yield self.draws.of_part(part)

    def values_of(self, trials: range) -> TrialSamples:
        """Return all samples of consecutive trials. Raises InputError."""
        return self.values_from(self.draws.of_part(trials), trials)

    def values_from(self, table: DrawTable, trials: range) -> TrialSamples:
        """Return the samples of trials from their table of draws. Raises InputError."""
        faults = [fault_of_trials(fault, table.columns, trials) for fault in self.campaign.faults]
        return TrialSamples(self.campaign, self.supplied, self.faults, trials, table, faults)

    def of_first(self, trials: int) -> BatchPlan:
        """Return a plan of the first ``trials`` trials, with unchanged draws."""
        return self.of_part(range(trials))

    def of_part(self, trials: range) -> BatchPlan:
        """Return a plan of consecutive trials, with unchanged draws.

        The draws must be supplied ones unless the trials begin with trial 0.
        """
        supplied = None if self.supplied is None else self.supplied.of_part(trials)
        draws = None
        if not self.is_counted:  # draws for fewer trials may differ
            draws = self.draws.of_part(trials) if trials.start else self.draws.of_first(trials.stop)
        campaign = replace(self.campaign, trials=len(trials))
        return replace(self, campaign=campaign, supplied=supplied, known_draws=draws)

    def of_samples(self, supplied: SuppliedDraws) -> BatchPlan:
        """Return a plan with a trial for each supplied sample, which determines derived values, faults and metrics.

        Lookups are omitted, since their numbers belong to the campaign's own draws. Raises InputError.
        """
        campaign = replace(self.campaign.without_lookups(), trials=supplied.trials)
        return replace(self, campaign=campaign, supplied=supplied, known_draws=None)

    @cached_property
    def groups(self) -> list[TrialGroup]:
        """Groups of trials by which results are summarised; empty if there is no [group]. Raises InputError."""
        if self.campaign.group is None:
            return []
        parts = (part.columns[self.campaign.group] for part in self.draw_parts())
        return groups_of(parts, (self.campaign.file, "group.by"))

    def list_faults(self) -> list[Fault]:
        """Return all faults, the campaign's first. Of the campaign's faults only connector and kind are meaningful."""
        return [*(Fault(fault.connector, fault.kind) for fault in self.campaign.faults), *self.faults]

    def faults_of(self, trial: int) -> list[Fault | None]:
        """Return the faults of one trial, in the order of `list_faults`; None for faults that do not act."""
        return self.values_of(range(trial, trial + 1)).faults_of(trial)

    def fault_texts(self) -> list[str]:
        return [str(fault) for fault in (*self.campaign.faults, *self.faults)]

    def prepare(self, variant: Variant) -> PreparedSystem:
        """Return the prepared system of one variant. Raises InputError."""
        options = self.options.merge(campaign=self.campaign.layer_of(variant))
        try:
            return prepare_system(self.archive or self.system, options, series=self.series)
        except InputError as error:
            compared = {*variant.use, *variant.use.values(), *(f"{slot}={fmu}" for slot, fmu in variant.use.items())}
            if error.file == "`use`" and error.element in compared:
                raise InputError(self._origin_of_fault(variant), error.element, error.problem, error.remedy) from error
            raise

    def _origin_of_fault(self, variant: Variant) -> str:
        """Return the origin of a variant's FMUs, for error messages."""
        if self.campaign.configurations:
            return f"{self.campaign.file}: configuration.{variant.name}.use"
        return self.compared_by or "compare"

    def parameters(self, prepared: PreparedSystem, trial: int) -> dict[str, float | int]:
        """Return the parameters of one trial: draws, and the seed and stream of every component that has them."""
        return self.values_of(range(trial, trial + 1)).parameters(prepared, trial)

    def parameter_names(self, prepared: PreparedSystem) -> set[str]:
        """Return the names of the `parameters`, which are the same for every trial."""
        sampled = {name for name in self.campaign.input_names() if "." in name}
        return sampled | {f"{name}.{number}" for name in with_streams(prepared) for number in (SEED, STREAM)}


def read_plan(
    system: str | Path,
    campaign: str,
    options: SystemOptions,
    *,
    trials: int | None = None,
    seed: int | None = None,
    compare: Mapping[str, Sequence[str]] | None = None,
    configuration: str | None = None,
    faults: Sequence[Fault] = (),
    series: InputSeries | None = None,
    watch: Watch | None = None,
    until_decided: bool = False,
    draws: Path | None = None,
    sweeps: Mapping[str, str] | None = None,
) -> BatchPlan:
    """Return the plan of a campaign, by name or path, with the changes of the command line. Raises InputError.

    ``compare`` replaces the campaign's comparison and configurations. ``configuration`` selects a variant; by default
    all variants are simulated. ``faults`` are added to the campaign's. ``series`` contains inputs over time. ``draws``
    is a file of draws that replace the campaign's, and ``sweeps`` maps parameters to low:high:step.
    """
    archive = open_system(system)
    raw, label = archive.campaign(campaign)
    source = read_source(raw, label, archive)
    read = parse_campaign(source.table())
    is_its = archive.path.suffix == ".ssp" and label.startswith(f"{archive.label}!")  # regardless of the archive's name
    if not is_called(read.system, archive.name) and not is_its:
        raise InputError(
            label, "system", f"the campaign is for {read.system}, not {archive.name}", f"simulate {read.system}"
        )
    _check_changes(trials, draws, sweeps or {})
    changed = _change(read, trials, seed, compare, sweeps or {})
    if configuration is not None:
        changed = changed.select(configuration)
    if until_decided and not changed.requirements:
        remedy = "declare a [requirement.NAME]"
        raise InputError(label, "`until_decided`", "the campaign has no requirement", remedy)
    plan = BatchPlan(
        str(system),
        changed,
        options,
        source.sha256,
        faults=tuple(faults),
        series=series,
        watch=watch or UNWATCHED,
        compared_by=f"{label}: compare" if compare is None else "`compare`",
        source=source,
        until_decided=until_decided,
    )
    return plan if draws is None else plan.of_samples(read_supplied(draws, changed))


def _check_changes(trials: int | None, draws: Path | None, sweeps: Mapping[str, str]) -> None:
    """Reject changes that exclude each other. Raises InputError."""
    if trials is not None and trials < 1:
        raise InputError("`trials`", str(trials), "not a positive number", "give 1 or more")
    if draws is not None and trials is not None:
        raise InputError(
            "`trials`",
            str(trials),
            "the file of `draws` determines the number of trials",
            "leave out `trials` or `draws`",
        )
    if draws is not None and sweeps:
        raise InputError(
            "`set`", "=".join(next(iter(sweeps.items()))), "a sweep cannot be combined with `draws`", "give one value"
        )


def _change(
    campaign: Campaign,
    trials: int | None,
    seed: int | None,
    compare: Mapping[str, Sequence[str]] | None,
    sweeps: Mapping[str, str],
) -> Campaign:
    """Return a campaign with the changes of the command line, as in `read_plan`. Raises InputError."""
    changed = replace(
        campaign,
        trials=campaign.trials if trials is None else trials,
        seed=campaign.seed if seed is None else seed,
        compare=campaign.compare if compare is None else {slot: tuple(fmus) for slot, fmus in compare.items()},
        configurations=campaign.configurations if compare is None else (),
    )
    return with_sweeps(changed, sweeps)
