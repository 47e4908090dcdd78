"""Request for a stability study: system, options, loops, points and campaign, checked before any simulation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ....common.errors import InputError, suggestion
from ...campaigns.definition.checks import check_plan
from ...campaigns.definition.plan import BatchPlan, read_plan
from ...runtime.ssp.archive import open_system
from ...runtime.ssp.ssd_reader import read_description
from ...runtime.ssp.system_description import SystemDescription
from ...runtime.system.fmu import Fmu
from ...runtime.system.options import Layer, SystemOptions
from ...runtime.system.prepared import PreparedSystem, prepare_system
from .channels import channels_of
from .declaration import Declaration, LoopDeclaration, PointDeclaration
from .loop_declaration import read_declaration


@dataclass(frozen=True)
class Request:
    """Request for a study, small enough to be sent to every worker.

    ``name`` and ``label`` identify the system and its place in messages. ``plan`` is the campaign over which margins
    are dispersed, ``campaign`` is its name as requested, and ``draws`` is the file of supplied draws. ``at`` contains
    the user's times (s) of points; it is empty if the declared points are used.
    """

    name: str
    label: str
    system: str
    options: SystemOptions
    declaration: Declaration
    campaign: str | None = None
    plan: BatchPlan | None = None
    draws: Path | None = None
    at: tuple[float, ...] = ()

    def loops_at(self, point: PointDeclaration) -> list[LoopDeclaration]:
        return [loop for loop in self.declaration.loops if point.name in loop.points]

    def loop(self, name: str) -> LoopDeclaration:
        return next(loop for loop in self.declaration.loops if loop.name == name)

    def point(self, name: str) -> PointDeclaration:
        return next(point for point in self.declaration.points if point.name == name)


def read_request(
    system: str | Path,
    options: SystemOptions,
    *,
    loops: Sequence[str] = (),
    at: Sequence[float] = (),
    campaign: str | None = None,
    configuration: str | None = None,
    trials: int | None = None,
    seed: int | None = None,
    trial: int | None = None,
    draws: Path | None = None,
) -> Request:
    """Return the request for a study of all or some of a system's loops.

    ``loops`` are names of declared loops, or connectors to be cut at the times ``at`` (s; 0 by default). With ``at``,
    declared loops are studied at these times, too, with the settings of their declared points, and without sweeps,
    which belong to the declared points. With ``campaign``, and ``configuration`` for one of its variants, margins are
    dispersed over its trials; with ``trial``, the study uses the draws of this trial instead. ``draws`` is a file of
    draws that replace the campaign's. Raises InputError.
    """
    archive = open_system(system)
    times = tuple(sorted(set(map(float, at))))
    declaration = _select(read_description(archive, options.chosen["variant"]), loops, times, options)
    request = Request(archive.name, archive.label, str(system), options, declaration, at=times)
    if campaign is None:
        without = {"configuration": configuration, "trials": trials, "seed": seed, "trial": trial, "draws": draws}
        for name, value in without.items():
            if value is not None:
                raise InputError(f"`{name}`", str(value), "needs a campaign", "also give `campaign`")
        return request
    plan = read_plan(system, campaign, options, configuration=configuration, trials=trials, seed=seed, draws=draws)
    if configuration is None:
        plan = replace(
            plan, campaign=replace(plan.campaign, compare={})
        )  # without compared FMUs, since a study is of a single system
    if len(names := [each.name for each in plan.campaign.variants()]) > 1:
        problem = f"the campaign has {len(names)} configurations, but a study needs one"
        raise InputError(plan.campaign.file, "`configuration`", problem, f"give `configuration` {names[0]}")
    check_plan(plan)
    if trial is None:
        return replace(request, campaign=campaign, plan=plan, draws=draws)
    return replace(request, options=_values_of_trial(plan, options, trial))


def _select(
    description: SystemDescription, names: Sequence[str], at: Sequence[float], options: SystemOptions
) -> Declaration:
    """Return the declaration with only the requested loops."""
    declared = read_declaration(description)
    by_name = {loop.name: loop for loop in declared.loops}
    for time in at:
        if not (math.isfinite(time) and time >= description.start_time):
            remedy = f"give {description.start_time:g} s or later"
            raise InputError("`at`", f"{time:g}", "not a time of the simulation", remedy)
    if not names and not declared.loops:
        remedy = "name a loop in the SSD, or cut one with `loops` COMPONENT.CONNECTOR `at`"
        raise InputError(description.file, "", "declares no loops", remedy)
    cuts = [PointDeclaration(f"t = {time:g} s", time=time) for time in at or (0.0,)]
    selected: list[LoopDeclaration] = []
    for name in dict.fromkeys(names or by_name):
        if name not in by_name and "." not in name:
            remedy = f"{suggestion(name, by_name)}, or cut a loop" if by_name else "the SSD names none; cut a loop"
            raise InputError("`loops`", name, "the SSD declares no such loop", f"{remedy} with COMPONENT.CONNECTOR")
        selected.append(
            by_name.get(name) or LoopDeclaration(name, cut=name, points=tuple(point.name for point in cuts))
        )
    points, sweeps = (*declared.points, *cuts), declared.sweeps
    if at:
        requested = {name for loop in selected for name in loop.points}
        here = [point for point in declared.points if point.name in requested]
        points, sweeps = (*_shift(here, at), *cuts), ()
        # with `at`, of several points that differ only by time the first is used
        same = {point.name: (_remaining(point.layer, options), point.until) for point in here}
        origins = {name: next(other for other in same if same[other] == same[name]) for name in same}
        for index, loop in enumerate(selected):
            if loop.name in by_name:
                different = dict.fromkeys(origins[name] for name in loop.points)
                names_at = tuple(_name_at(name, time) for name in different for time in at)
                selected[index] = replace(loop, points=names_at)
    used = {point for loop in selected for point in loop.points}
    retained = {loop.name for loop in selected}
    return Declaration(
        declared.limits,
        tuple(point for point in points if point.name in used),
        tuple(selected),
        tuple(sweep for sweep in sweeps if sweep.loop in retained),
    )


def _remaining(layer: Layer, options: SystemOptions) -> Layer:
    """Return the settings of a point that the user's options do not override."""
    use = {component: fmu for component, fmu in layer.use.items() if component not in options.use}
    values = {name: value for name, value in layer.set.items() if name not in options.set}
    return replace(layer, use=use, set=values)


def _shift(points: Sequence[PointDeclaration], at: Sequence[float]) -> list[PointDeclaration]:
    """Return declared points at other times. Raises InputError for times after the end of a point."""
    shifted = []
    for point in points:
        for time in at:
            if point.until is not None and time >= point.until:
                problem = f"point {point.name} ends at {point.until:g} s"
                raise InputError("`at`", f"{time:g}", problem, "give earlier times, or select other loops with `loops`")
            name = _name_at(point.name, time)
            phase = f"settings of {point.name}"
            shifted.append(replace(point, name=name, time=time, signal=None, falls_to=None, phase=phase))
    return shifted


def _name_at(point: str, time: float) -> str:
    return f"{point}, t = {time:g} s"


def _values_of_trial(plan: BatchPlan, options: SystemOptions, trial: int) -> SystemOptions:
    """Return options with the draws of one trial as settings, which override the campaign's and yield to the user's."""
    if not 0 <= trial < plan.campaign.trials:
        problem = f"the campaign has trials 0 to {plan.campaign.trials - 1}"
        raise InputError("`trial`", str(trial), problem, "give one of these trials")
    (variant,) = plan.campaign.variants()
    prepared = plan.prepare(variant)
    sampled = {name: str(value) for name, value in plan.parameters(prepared, trial).items()}
    return options.merge(campaign=plan.campaign.layer_of(variant), draws=Layer(set=sampled))


@dataclass(frozen=True)
class Subject:
    """System with options; `changed` returns another subject that shares its loaded FMUs."""

    system: str
    options: SystemOptions
    fmus: dict[str, Fmu] = field(default_factory=dict)

    def with_options(self, *, step: float | None = None, **layers: Layer) -> Subject:
        """Return the subject with another communication step (s), and further options by the names of `LAYERS`."""
        options = self.options.merge(**layers)
        return replace(self, options=options if step is None else options.replace(step=step))

    def at(self, point: PointDeclaration, study: Layer | None = None) -> PreparedSystem:
        """Return the system prepared at a point, with ``study`` as the top layer. Raises InputError."""
        options = self.options.merge(operating_point=point.layer, study=study or Layer())
        return prepare_system(self.system, options, self.fmus)


def check_loops(subject: Subject, declared: Declaration) -> None:
    """Reject an operating point that cannot be set, and a loop without a signal at its cut. Raises InputError."""
    points = {point.name: subject.at(point) for point in declared.points}
    for loop in declared.loops:
        for name in loop.points:
            channels_of(loop, points[name].network, points[name].step)
