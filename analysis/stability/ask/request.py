"""What is asked of a study: a system, its loops and points, a campaign; read and checked before anything flies."""

from __future__ import annotations

import math
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...campaign.checks import check_plan
from ...campaign.plan import BatchPlan, read_plan
from ...errors import InputError, suggestion
from ...ssp.archive import open_system
from ...ssp.description import Description
from ...ssp.reading import read_description
from ...system.options import Layer, SystemOptions
from .declaration import Declaration, Loop, Point
from .reading import read_declaration


@dataclass(frozen=True)
class Request:
    """A study to be made; small enough to be sent to every worker.

    ``name`` is the system's and ``label`` its place, for messages. ``plan`` is the campaign that margins are
    dispersed over, ``campaign`` its name as it was given, ``draws`` the file of its draws where it draws none.
    """

    name: str
    label: str
    system: str
    options: SystemOptions
    declaration: Declaration
    campaign: str | None = None
    plan: BatchPlan | None = None
    draws: Path | None = None

    def loops_at(self, point: Point) -> list[Loop]:
        """The loops that are studied at a point."""
        return [loop for loop in self.declaration.loops if point.name in loop.points]

    def loop(self, name: str) -> Loop:
        return next(loop for loop in self.declaration.loops if loop.name == name)

    def point(self, name: str) -> Point:
        return next(point for point in self.declaration.points if point.name == name)

    def replay(self, loop: str, trial: int) -> str:
        """The command that studies one trial of the campaign again."""
        assert self.plan is not None
        assert self.campaign is not None
        options = self.options
        words = ["perilune", "stability", self.system, "--campaign", self.campaign]
        words += ["--trial", str(trial)]
        words += ["--trials", str(self.plan.campaign.trials)] if self.draws is None else ["--draws", str(self.draws)]
        words += ["--seed", str(self.plan.campaign.seed), "--loop", loop]
        points = [self.point(name) for name in self.loop(loop).points]
        words += [word for point in points if _is_asked(point) for word in ("--at", repr(point.time))]
        for slot, fmu in options.use.items():
            words += ["--use", f"{slot}={fmu}"]
        for name in options.parameters:
            words += ["--parameters", name]
        for name, value in options.set.items():
            words += ["--set", f"{name}={value}"]
        chosen = {
            "--step": options.step,
            "--stop-time": options.stop_time,
            "--variant": options.variant,
            "--flavour": options.flavour,
            "--algorithm": options.algorithm,
        }
        for option, choice in chosen.items():
            words += [] if choice is None else [option, str(choice)]
        for name in options.feedthrough:
            words += ["--feedthrough", name]
        for name in options.no_feedthrough:
            words += ["--no-feedthrough", name]
        words += ["--allow-unmatched"] if options.allow_unmatched else []
        words += ["--strict"] if options.strict else []
        words += ["--open-inputs", options.open_inputs] if options.open_inputs != SystemOptions().open_inputs else []
        return shlex.join(words)


def read_request(
    system: str | Path,
    options: SystemOptions,
    *,
    loops: Sequence[str] = (),
    at: float | None = None,
    campaign: str | None = None,
    trials: int | None = None,
    seed: int | None = None,
    trial: int | None = None,
    draws: Path | None = None,
) -> Request:
    """The study of a system's declared loops, or of some.

    ``loops`` are names of declared loops, or connectors of loops that are not declared, which are cut at time
    ``at`` (s; 0 unless given). With ``campaign`` margins are dispersed over its trials, or with ``trial`` the study is
    made of that trial's draws. ``draws`` is a file of draws to take in place of drawn ones. Raises InputError.
    """
    archive = open_system(system)
    declaration = _chosen(read_description(archive, options.variant), loops, at)
    request = Request(archive.name, archive.label, str(system), options, declaration)
    if campaign is None:
        for name, value in (("--trials", trials), ("--seed", seed), ("--trial", trial), ("--draws", draws)):
            if value is not None:
                raise InputError(name, str(value), "there is no campaign", "give --campaign NAME with it")
        return request
    plan = read_plan(system, campaign, options, trials=trials, seed=seed, draws=draws)
    plan = replace(plan, campaign=replace(plan.campaign, compare={}))  # of FMUs; a study is of one system
    check_plan(plan)
    if trial is None:
        return replace(request, campaign=campaign, plan=plan, draws=draws)
    return replace(request, options=_drawn(plan, options, trial))


def _chosen(description: Description, names: Sequence[str], at: float | None) -> Declaration:
    """The declaration with just the loops that are asked for."""
    declared = read_declaration(description)
    by_name = {loop.name: loop for loop in declared.loops}
    if at is not None and not (math.isfinite(at) and at >= description.start_time):
        raise InputError(
            "--at", str(at), "not a time of the flight", f"give seconds from {description.start_time:g} on"
        )
    if at is not None and all(name in by_name for name in names):
        raise InputError("--at", f"{at:g}", "it is for loops that the SSD does not name", "leave it out")
    if not names:
        if not declared.loops:
            remedy = "name a loop in the SSD, or cut one with --loop COMPONENT.CONNECTOR --at SECONDS"
            raise InputError(description.file, "", "declares no loops", remedy)
        return declared
    here = _point(0.0 if at is None else at)
    wanted: list[Loop] = []
    for name in dict.fromkeys(names):
        if name not in by_name and "." not in name:
            raise InputError("--loop", name, "the SSD names no such loop", _remedy(name, by_name))
        wanted.append(by_name.get(name) or Loop(name, cut=name, points=(here.name,)))
    points = (*declared.points, here)
    used = {point for loop in wanted for point in loop.points}
    kept = {loop.name for loop in wanted}
    return Declaration(
        declared.limits,
        tuple(point for point in points if point.name in used),
        tuple(wanted),
        tuple(sweep for sweep in declared.sweeps if sweep.loop in kept),
    )


def _point(time: float) -> Point:
    """The point of loops that no description names, called by its time (s)."""
    return Point(f"t = {time:g} s", time=time)


def _is_asked(point: Point) -> bool:
    return point.time is not None and point == _point(point.time)


def _remedy(name: str, declared: Mapping[str, Loop]) -> str:
    if not declared:
        return "it names none; cut one with COMPONENT.CONNECTOR"
    return f"{suggestion(name, declared)}, or cut one with COMPONENT.CONNECTOR"


def _drawn(plan: BatchPlan, options: SystemOptions, trial: int) -> SystemOptions:
    """Options with the draws of one trial as settings, over the campaign's own and below the user's."""
    if not 0 <= trial < plan.campaign.trials:
        problem = f"the campaign has trials 0 to {plan.campaign.trials - 1}"
        raise InputError("--trial", str(trial), problem, "give one of them")
    prepared = plan.prepare(plan.campaign.variants()[0])
    drawn = {name: str(value) for name, value in plan.parameters(prepared, trial).items()}
    return options.among(campaign=plan.campaign.layer, draws=Layer(set=drawn))
