"""A campaign made concrete: system, options, draws and variants, checked before anything flies."""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from ..errors import InputError, suggestion
from ..ssp.archive import SystemArchive, open_system
from ..system.faults import Fault, check_fault
from ..system.in_flight.series import InputSeries
from ..system.in_flight.watch import UNWATCHED, Watch
from ..system.options import Layer, SystemOptions
from ..system.prepared import PreparedSystem, prepare_system
from .campaign import Campaign, Variant
from .draws import DrawTable, draw_table, stream_numbers, table_of
from .faults import DrawnFault, check_drawn, drawn_fault
from .file import parse_campaign
from .given import GivenDraws, read_given
from .groups import Group, groups_of
from .metrics import names_needed
from .sweeps import with_sweeps
from .toml_table import Table


@dataclass(frozen=True)
class BatchPlan:
    """What a batch flies; small enough to be sent to every worker.

    ``options`` are the user's system options, which come after the campaign's own and win; draws
    win over parameter sets. ``campaign_sha256`` is that of the campaign's file. ``overlaid`` names
    parameters that whoever flies the plan gives anew with every flight. ``faults`` are the user's, which fly in
    every trial after the campaign's own, ``series`` the inputs over time that all trials have; ``watch`` is how each
    is watched. ``given`` are draws that fly in place of drawn ones.
    """

    system: str
    campaign: Campaign
    options: SystemOptions
    campaign_sha256: str = ""
    overlaid: tuple[str, ...] = ()
    faults: tuple[Fault, ...] = ()
    series: InputSeries | None = None
    watch: Watch = UNWATCHED
    given: GivenDraws | None = None
    compared_by: str = ""  # what errors name for the compared FMUs: --compare, or the campaign's file
    campaign_data: bytes = b""  # the campaign's file
    until_decided: bool = False  # whether it ends as soon as the campaign's requirements are decided
    archive: SystemArchive | None = None  # flown instead of what `system` names, for which it stands

    @cached_property
    def draws(self) -> DrawTable:
        """The table of draws of all trials. Raises InputError."""
        if self.given is not None:
            return table_of(self.campaign, self.given.table)
        try:
            return draw_table(self.campaign)
        except MemoryError as error:
            problem = f"the draws of {self.campaign.trials} trials do not fit into memory"
            raise InputError(self.campaign.file, "trials", problem, "give fewer") from error

    def of_first(self, trials: int) -> BatchPlan:
        """A plan of the first ``trials`` trials, with the draws that they have in this one."""
        return self.of_part(range(trials))

    def of_part(self, trials: range) -> BatchPlan:
        """A plan of trials in a row, with the draws that they have in this one; from 1 on, those must be given."""
        given = None if self.given is None else self.given.of_part(trials)
        part = replace(self, campaign=replace(self.campaign, trials=len(trials)), given=given)
        part.__dict__["draws"] = self.draws.of_part(trials)  # in cached_property's place: drawn anew they may differ
        return part

    def of_samples(self, given: GivenDraws) -> BatchPlan:
        """A plan that flies given draws, a trial for each: values derived of them, faults and metrics follow."""
        return replace(self, campaign=replace(self.campaign, trials=given.trials), given=given)

    @cached_property
    def groups(self) -> list[Group]:
        """The groups of trials that results are summed up by; none without [group]. Raises InputError."""
        if self.campaign.group is None:
            return []
        return groups_of(self.draws.columns[self.campaign.group], (self.campaign.file, "group.by"))

    @cached_property
    def drawn_faults(self) -> list[DrawnFault]:
        """The campaign's faults in all trials. Raises InputError."""
        return [drawn_fault(fault, self.draws.columns, self.draws.trials) for fault in self.campaign.faults]

    def declared_faults(self) -> list[Fault]:
        """All faults, the campaign's first, with their connectors and kinds; value and times are a trial's."""
        return [*(Fault(fault.connector, fault.kind) for fault in self.campaign.faults), *self.faults]

    def faults_of(self, trial: int) -> list[Fault | None]:
        """The faults of one trial, in the order of `declared_faults`; None for one that does not fly in it."""
        return [*(fault.in_trial(trial) for fault in self.drawn_faults), *self.faults]

    def fault_texts(self) -> list[str]:
        """All faults as results name them."""
        return [str(fault) for fault in (*self.campaign.faults, *self.faults)]

    def prepare(self, variant: Variant) -> PreparedSystem:
        """The system as one variant flies it. Raises InputError."""
        options = self.options.among(campaign=self.campaign.layer, study=Layer(use=variant.use))
        try:
            return prepare_system(self.archive or self.system, options, series=self.series)
        except InputError as error:
            compared = {*variant.use, *variant.use.values(), *(f"{slot}={fmu}" for slot, fmu in variant.use.items())}
            if error.file == "--use" and error.element in compared:
                raise InputError(self.compared_by or "compare", error.element, error.problem, error.remedy) from error
            raise

    def parameters(self, prepared: PreparedSystem, trial: int) -> dict[str, float | int]:
        """The parameters of one trial: draws, and seed and stream of every component that has them."""
        whose = trial if self.given is None else self.given.stream_of(trial)
        streams = stream_numbers(self.campaign.seed, whose, prepared.network.fmus, self.campaign.file)
        values: dict[str, float | int] = dict(self.draws.parameters(trial))
        for name, fmu in prepared.network.fmus.items():
            if {"seed", "stream"} <= set(fmu.variables):
                values[f"{name}.seed"], values[f"{name}.stream"] = streams[name]
        return values


def campaign_of(data: bytes, label: str) -> Campaign:
    """The campaign that a file declares, which ``label`` names in messages. Raises InputError."""
    try:
        table = Table(tomllib.loads(data.decode("utf-8")), label)
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise InputError(label, "", f"not TOML: {error}", "correct the file at that place") from error
    return parse_campaign(table)


def read_plan(
    system: str | Path,
    campaign: str,
    options: SystemOptions,
    *,
    trials: int | None = None,
    seed: int | None = None,
    compare: Mapping[str, Sequence[str]] | None = None,
    faults: Sequence[Fault] = (),
    series: InputSeries | None = None,
    watch: Watch | None = None,
    until_decided: bool = False,
    draws: Path | None = None,
    sweeps: Mapping[str, str] | None = None,
) -> BatchPlan:
    """Read a campaign by name or path, with the command line's changes. Raises InputError.

    ``compare`` replaces the campaign's own comparison, ``faults`` come after its own, ``series`` are inputs over time,
    ``draws`` is a file of draws to fly in place of drawn ones, ``sweeps`` are parameters with their low:high:step.
    """
    archive = open_system(system)
    data, label = archive.campaign(campaign)
    read = campaign_of(data, label)
    if read.system.removesuffix(".ssp").removesuffix(".fmu") != archive.name:
        raise InputError(label, "system", f"the campaign is for {read.system}, not {archive.name}", "fly that system")
    changes: dict = {}
    if trials is not None:
        if trials < 1:
            raise InputError("--trials", str(trials), "not a positive number", "give 1 or more")
        changes["trials"] = trials
    if seed is not None:
        changes["seed"] = seed
    if compare is not None:
        changes["compare"] = {slot: tuple(fmus) for slot, fmus in compare.items()}
    if draws is not None and trials is not None:
        raise InputError("--trials", str(trials), "the file of --draws says how many", "leave one of the two out")
    if draws is not None and sweeps:
        raise InputError("--set", "=".join(next(iter(sweeps.items()))), "a sweep beside --draws", "leave one out")
    changed = with_sweeps(replace(read, **changes), sweeps or {})
    if until_decided and not changed.requirements:
        remedy = "declare what is to be decided: [requirement.NAME]"
        raise InputError(label, "--until-decided", "the campaign has no requirement", remedy)
    plan = BatchPlan(
        str(system),
        changed,
        options,
        hashlib.sha256(data).hexdigest(),
        faults=tuple(faults),
        series=series,
        watch=watch or UNWATCHED,
        compared_by=f"{label}: compare" if compare is None else "--compare",
        campaign_data=data,
        until_decided=until_decided,
    )
    return plan if draws is None else plan.of_samples(read_given(draws, changed))


def check_plan(plan: BatchPlan) -> dict[str, PreparedSystem]:
    """Prepare every variant once, so that wrong input is reported before anything flies; by variant."""
    _ = plan.draws, plan.groups, plan.drawn_faults
    _refuse_conflicts(plan)
    systems = {variant.name: plan.prepare(variant) for variant in plan.campaign.variants()}
    for prepared in systems.values():
        check_draws(plan, prepared)
        for fault in plan.faults:
            check_fault(prepared.network, fault)
    return systems


def check_draws(plan: BatchPlan, prepared: PreparedSystem) -> None:
    """Refuse draws and drawn faults that a prepared system cannot have. Raises InputError."""
    for name in variant_names(plan, prepared).varied:
        _check_varied(plan, prepared, name)
    for drawn in plan.drawn_faults:
        check_drawn(drawn, prepared.network)


def _refuse_conflicts(plan: BatchPlan) -> None:
    """Refuse options that the campaign would overrule: FMUs of a compared slot, values that are drawn."""
    for slot in plan.campaign.compare:
        if slot in plan.options.use:
            raise InputError("--use", slot, "the campaign compares FMUs in this slot", f"give --compare {slot}=A,B")
    for name in plan.options.set:
        drawn = any(column == name or column.startswith(f"{name}[") for column in plan.draws.columns)
        if drawn or name.endswith((".seed", ".stream")):
            raise InputError("--set", name, "the campaign draws it in every trial", "change the campaign, or --seed")


def _check_varied(plan: BatchPlan, prepared: PreparedSystem, name: str) -> None:
    """Refuse a draw for what is no parameter, or with a value that the parameter cannot have."""
    place = plan.campaign.place_of(name)
    known: list[str] = []
    for component, fmu in prepared.network.fmus.items():
        known += [
            f"{component}.{key}" for key, value in fmu.variables.items() if value.causality in ("parameter", "input")
        ]
    if name not in known:
        raise InputError(place, name, "no such parameter in the system", suggestion(name, known))
    if name in prepared.network.driven:
        problem = f"is driven by column {prepared.network.driven[name]} of the inputs over time"
        raise InputError(place, name, problem, "leave out the column or the draw")
    if name not in plan.draws.columns:  # seed, stream or overlaid
        return
    values = np.asarray(plan.draws.columns[name], dtype=float)
    component = max((part for part in prepared.network.fmus if name.startswith(f"{part}.")), key=len)
    variable = prepared.network.fmus[component].variables[name.removeprefix(f"{component}.")]
    if variable.type == "String":
        raise InputError(place, name, "a String cannot be drawn", "draw numbers only")
    if variable.type != "Real" and np.any(values != np.round(values)):
        remedy = "sweep whole numbers" if name in plan.campaign.sweeps else "use a choice"
        raise InputError(place, name, f"drawn values are not whole, it is {variable.type}", remedy)
    low, high = (
        limit if bound is None else float(bound) for bound, limit in ((variable.min, -np.inf), (variable.max, np.inf))
    )
    outside = np.flatnonzero((values < low) | (values > high))
    if outside.size:
        problem = f"{values[outside[0]]:g} in trial {outside[0]} is outside {low:g} to {high:g}"
        raise InputError(place, name, problem, "draw values that the parameter can have")


@dataclass(frozen=True)
class VariantNames:
    """What one variant varies, records and holds constant, by name."""

    varied: list[str]
    signals: list[str]
    statuses: list[str]
    constants: dict[str, float]


def variant_names(plan: BatchPlan, prepared: PreparedSystem) -> VariantNames:
    """Names that a variant's simulation needs. Raises InputError for one that does not exist."""
    campaign = plan.campaign
    needed = names_needed(campaign.metrics, plan.draws.columns)
    recorded = {*campaign.record.final, *campaign.record.signals}
    needed |= recorded
    signals: list[str] = []
    constants: dict[str, float] = {}
    for name in sorted(needed):
        if _is_signal(prepared, name) or _is_output(prepared, name):
            signals.append(name)
        elif name in recorded:
            known = [other for other in prepared.network.nodes if _is_signal(prepared, other)]
            raise InputError(campaign.file, f"record: {name}", "not a signal of the system", suggestion(name, known))
        else:
            constants[name] = _constant(plan, prepared, name)
    statuses = [f"{name}.status" for name in prepared.network.fmus if _is_output(prepared, f"{name}.status")]
    return VariantNames(sorted({*plan.parameters(prepared, 0), *plan.overlaid}), signals, statuses, constants)


def _is_signal(prepared: PreparedSystem, name: str) -> bool:
    """Whether a connector's value comes from a connection or is a system's input."""
    if name in prepared.network.driven:
        return True
    node = prepared.network.nodes.get(name)
    if node is None or node.kind in ("parameter", "calculatedParameter"):
        return False
    return name in prepared.network.driver or name in prepared.settings.nodes


def _is_output(prepared: PreparedSystem, name: str) -> bool:
    return any(
        name.startswith(f"{component}.")
        and getattr(fmu.variables.get(name[len(component) + 1 :]), "causality", "") == "output"
        for component, fmu in prepared.network.fmus.items()
    )


def _constant(plan: BatchPlan, prepared: PreparedSystem, name: str) -> float:
    """The value of a parameter that metrics refer to."""
    for component, fmu in prepared.network.fmus.items():
        variable = fmu.variables.get(name.removeprefix(f"{component}."))
        if name.startswith(f"{component}.") and variable is not None and variable.start is not None:
            value = prepared.settings.variables.get((component, variable.name), variable.start)
            return float({"true": 1, "false": 0}.get(str(value).lower(), value))
    known = [f"{component}.{key}" for component, fmu in prepared.network.fmus.items() for key in fmu.variables]
    problem = "neither a signal nor a parameter of the system"
    raise InputError(plan.campaign.file, name, problem, suggestion(name, known))
