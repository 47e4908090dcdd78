"""Checks of a plan before its simulation: every variant is prepared, every draw and every name is checked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ....common.errors import InputError, suggestion
from ...runtime.fmi.representations import TEXTS
from ...runtime.ssp.names import split_name
from ...runtime.system.checks import check_fault
from ...runtime.system.fmu import NOT_VARIED, STRUCTURAL
from ...runtime.system.prepared import PreparedSystem
from ..draws.interfaces import input_names
from ..draws.lookup import Lookup
from ..draws.supplied import ALL, stream_column
from .faults import check_drawn
from .metrics import names_needed
from .plan import BatchPlan, with_streams

OVER_TIME = ("output", "local", "calculatedParameter", "independent")  # causalities of values that may change over time


def check_plan(plan: BatchPlan) -> dict[str, PreparedSystem]:
    """Check a plan completely, and return its prepared systems by variant. Raises InputError."""
    first = next(plan.draw_parts())  # samples of all trials are checked block by block, after everything else
    plan.values_from(first, range(first.trials))
    _ = plan.groups
    _refuse_conflicts(plan)
    systems = prepare_variants(plan)
    for prepared in systems.values():
        for fault in plan.faults:
            check_fault(prepared.network, fault)
    check_draws(plan, systems.values())
    check_lookups(plan, systems)
    return systems


def prepare_variants(plan: BatchPlan) -> dict[str, PreparedSystem]:
    """Return the prepared system of every variant. Raises InputError."""
    return {variant.name: plan.prepare(variant) for variant in plan.campaign.variants()}


def check_draws(plan: BatchPlan, systems: Iterable[PreparedSystem]) -> None:
    """Reject draws and drawn faults that a prepared system cannot have. Raises InputError."""
    systems = list(systems)
    _check_streams(plan, systems)
    sampled = set(plan.campaign.input_names())
    varied = []
    for prepared in systems:
        variables = {name: _vary(plan, prepared, name) for name in variant_names(plan, prepared).varied}
        varied.append((prepared, {name: each for name, each in variables.items() if name in sampled}))
    first = 0
    for part in plan.draw_parts():
        trials = plan.values_from(part, range(first, first + part.trials))
        for prepared, variables in varied:
            for name, variable in variables.items():
                _check_values(plan, name, variable, part.columns[name], first)
            for fault in trials.faults:
                check_drawn(fault, prepared.network)
        first += part.trials


def check_lookups(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> None:
    """Reject lookup tables that were not computed for the trials of every variant. Raises InputError."""
    for lookup in plan.campaign.lookups:
        checked: list[dict[str, float]] = []
        for variant, prepared in systems.items():
            constants = lookup_constants(plan, prepared, lookup)
            if constants in checked:
                continue
            checked.append(constants)
            first = 0
            for part in plan.draw_parts():
                trials = range(first, first + part.trials)
                lookup.check(lookup.input_columns({**constants, **part.columns}, part.trials), trials, variant)
                first = trials.stop


def lookup_constants(plan: BatchPlan, prepared: PreparedSystem, lookup: Lookup) -> dict[str, float]:
    """Return, by name, the undrawn parameters of a variant to which the inputs of a lookup refer.

    Raises InputError for a name that is neither drawn nor a parameter.
    """
    sampled = {*input_names(plan.campaign), *plan.campaign.derived}
    constants = {}
    for formula in lookup.formulas:
        for name in sorted(formula.names - sampled):
            if _is_signal(prepared, name) or _causality(prepared, name) in OVER_TIME:
                problem = f"{name} varies during a simulation"
                raise InputError(*formula.where, problem, "use draws, derived values and parameters")
            constants[name] = _constant(plan, prepared, name)
    return constants


def _check_streams(plan: BatchPlan, systems: Sequence[PreparedSystem]) -> None:
    """Reject random streams for a component that does not use any."""
    if plan.supplied is None:
        return
    known = sorted({name for prepared in systems for name in with_streams(prepared)})
    for name in plan.supplied.streams:
        if name != ALL and name not in known:
            where = (plan.supplied.file or plan.campaign.file, stream_column(name))
            remedy = suggestion(name, known) if known else "remove the column"
            raise InputError(*where, "no component that draws random numbers has this name", remedy)


class _Variable(NamedTuple):
    """FMI type and limits of a varied variable."""

    type: str
    minimum: float
    maximum: float


def _refuse_conflicts(plan: BatchPlan) -> None:
    """Reject options that the campaign would override: FMUs of compared components, and drawn values."""
    variants = plan.campaign.variants()
    for slot in plan.options.use:
        if slot in plan.campaign.compare:
            raise InputError("`use`", slot, "the campaign compares FMUs in this slot", f"give `compare` {slot}=A,B")
        if any(slot in variant.use for variant in variants):
            raise InputError(
                "`use`", slot, "the campaign's configurations choose this FMU", "change these configurations"
            )
    for name in plan.options.set:
        if any(name in variant.settings for variant in variants):
            raise InputError(
                "`set`", name, "the campaign's configurations set this variable", "change these configurations"
            )
        sampled = any(column == name or column.startswith(f"{name}[") for column in plan.campaign.input_names())
        if sampled or name.endswith((".seed", ".stream")):
            raise InputError(
                "`set`", name, "the campaign draws this variable in every trial", "remove the draw from the campaign"
            )


def _vary(plan: BatchPlan, prepared: PreparedSystem, name: str) -> _Variable:
    """Return the variable of this name, to be varied. Raises InputError unless it is a parameter that can be drawn."""
    place = plan.campaign.place_of(name)
    known: list[str] = []
    for component, fmu in prepared.network.fmus.items():
        known += [
            f"{component}.{key}" for key, value in fmu.variables.items() if value.causality in ("parameter", "input")
        ]
    if _causality(prepared, name) == STRUCTURAL:
        raise InputError(place, name, *NOT_VARIED)
    if name not in known:
        raise InputError(place, name, "no such parameter in the system", suggestion(name, known))
    if name in prepared.network.driven:
        problem = f"is driven by column {prepared.network.driven[name]} of the inputs over time"
        raise InputError(place, name, problem, "leave out the column or the draw")
    component = max((part for part in prepared.network.fmus if name.startswith(f"{part}.")), key=len)
    variable = prepared.network.fmus[component].variables[name.removeprefix(f"{component}.")]
    if variable.type in TEXTS and name in plan.campaign.input_names():
        raise InputError(place, name, f"a {variable.type} cannot be drawn", "draw numbers only")
    minimum = -np.inf if variable.minimum is None else float(variable.minimum)
    return _Variable(variable.type, minimum, np.inf if variable.maximum is None else float(variable.maximum))


def _check_values(plan: BatchPlan, name: str, variable: _Variable, values: np.ndarray, first: int) -> None:
    """Reject values that a parameter cannot have; the first value belongs to trial ``first``."""
    place = plan.campaign.place_of(name)
    if variable.type != "Real" and np.any(values != np.round(values)):
        remedy = "sweep whole numbers" if name in plan.campaign.sweeps else "use a choice"
        raise InputError(
            place, name, f"the drawn values are not whole numbers, but the variable is of type {variable.type}", remedy
        )
    _, low, high = variable
    outside = np.flatnonzero((values < low) | (values > high))
    if outside.size:
        problem = f"{values[outside[0]]:g} in trial {first + outside[0]} is outside {low:g} to {high:g}"
        raise InputError(place, name, problem, "draw values within these limits")


@dataclass(frozen=True)
class VariantNames:
    """Names of the varied parameters, recorded signals and constants of one variant."""

    varied: list[str]
    signals: list[str]
    statuses: list[str]
    constants: dict[str, float]


def variant_names(plan: BatchPlan, prepared: PreparedSystem) -> VariantNames:
    """Return the names that a variant's simulation needs. Raises InputError for unknown names."""
    campaign = plan.campaign
    needed = names_needed(campaign.metrics, campaign.input_names())
    recorded = {*campaign.record.final, *campaign.record.signals}
    needed |= recorded
    signals: list[str] = []
    constants: dict[str, float] = {}
    for name in sorted(needed):
        if _is_signal(prepared, name) or _causality(prepared, name) in OVER_TIME:
            signals.append(name)
        elif name in recorded:
            known = [other for other in prepared.network.nodes if _is_signal(prepared, other)]
            raise InputError(campaign.file, f"record: {name}", "not a signal of the system", suggestion(name, known))
        else:
            constants[name] = _constant(plan, prepared, name)
    statuses = [f"{name}.status" for name in prepared.network.fmus]
    statuses = [name for name in statuses if _causality(prepared, name) == "output"]
    return VariantNames(sorted({*plan.parameter_names(prepared), *plan.overlaid}), signals, statuses, constants)


def _is_signal(prepared: PreparedSystem, name: str) -> bool:
    """Return True if a connector's value comes from a connection or is an input of the system."""
    if name in prepared.network.driven:
        return True
    node = prepared.network.nodes.get(name)
    if node is None or node.kind in ("parameter", "calculatedParameter"):
        return False
    return name in prepared.network.driver or name in prepared.settings.nodes


def _causality(prepared: PreparedSystem, name: str) -> str:
    """Return the causality of an FMU's numeric or Boolean variable, or "" if there is no such variable."""
    component, variable_name = split_name(name, prepared.network.fmus)
    variable = prepared.network.fmus[component].variables.get(variable_name) if component else None
    return "" if variable is None or variable.type in TEXTS else variable.causality


def _constant(plan: BatchPlan, prepared: PreparedSystem, name: str) -> float:
    """Return the value of a parameter to which metrics refer."""
    for component, fmu in prepared.network.fmus.items():
        variable = fmu.variables.get(name.removeprefix(f"{component}."))
        if not name.startswith(f"{component}.") or variable is None or variable.type in TEXTS:
            continue
        if variable.start is not None:
            value = prepared.settings.variables.get((component, variable.name), variable.start)
            return float({"true": 1, "false": 0}.get(str(value).lower(), value))
    known = [f"{component}.{key}" for component, fmu in prepared.network.fmus.items() for key in fmu.variables]
    problem = "neither a signal nor a parameter of the system"
    raise InputError(plan.campaign.file, name, problem, suggestion(name, known))
