"""A whole study of a system's stability: its points, loops, sweeps and campaign, in one report."""

from __future__ import annotations

import shlex
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path

from analysis.batch.plan import BatchPlan, read_plan
from analysis.cosim.archive import open_system
from analysis.cosim.description import read_description
from analysis.cosim.system import PreparedSystem, SystemOptions
from analysis.errors import InputError, suggestion

from .declaration import Declaration, Limits, Loop, Point
from .dispersion import dispersed
from .limit_cycles import element_report
from .loop_study import LoopStudy
from .point_study import PointStudy
from .reading import read_declaration
from .results import Dispersion, LoopReport, StabilityReport
from .sampling import sampled
from .subject import Subject
from .sweep import swept

HERE = "command line"  # name of the point of loops that the command line names


class Study:
    """What is asked of one system, read and checked; `run` does it.

    ``loops`` are names of declared loops, or connectors of loops that are not declared, which are cut at time
    ``at`` (s; 0 unless given). With ``campaign`` margins are dispersed over its trials, or with ``trial`` the study is
    made of that trial's draws. Raises InputError.
    """

    def __init__(
        self,
        system: str | Path,
        options: SystemOptions,
        loops: Sequence[str] = (),
        at: float | None = None,
        campaign: str | None = None,
        trials: int | None = None,
        seed: int | None = None,
        trial: int | None = None,
    ) -> None:
        self.subject = Subject(str(system), options)
        self.archive = open_system(system)
        self.declaration = self._declared(loops, at)
        self.campaign = campaign
        self.plan: BatchPlan | None = None
        if campaign is None:
            for name, value in (("--trials", trials), ("--seed", seed), ("--trial", trial)):
                if value is not None:
                    raise InputError(name, str(value), "there is no campaign", "give --campaign NAME with it")
        else:
            self.plan = read_plan(system, campaign, options, trials=trials, seed=seed)
        if trial is not None:
            self._take_trial(trial)

    def _declared(self, names: Sequence[str], at: float | None) -> Declaration:
        """The declaration with just the loops that are asked for."""
        description = read_description(self.archive, self.subject.options.variant)
        declared = read_declaration(description)
        if at is not None and not any(name not in {loop.name for loop in declared.loops} for name in names):
            raise InputError("--at", f"{at:g}", "it is for loops that the SSD does not name", "leave it out")
        if not names:
            if not declared.loops:
                remedy = "name a loop in the SSD, or cut one with --loop COMPONENT.CONNECTOR --at SECONDS"
                raise InputError(description.file, "", "declares no loops", remedy)
            return declared
        by_name = {loop.name: loop for loop in declared.loops}
        wanted: list[Loop] = []
        for name in names:
            if name not in by_name and "." not in name:
                raise InputError("--loop", name, "the SSD names no such loop", _loop_remedy(by_name))
            wanted.append(by_name.get(name) or Loop(name, cut=name, points=(HERE,)))
        points = (*declared.points, Point(HERE, time=0.0 if at is None else at))
        used = {point for loop in wanted for point in loop.points}
        kept = {loop.name for loop in wanted}
        return Declaration(
            declared.limits,
            tuple(point for point in points if point.name in used),
            tuple(wanted),
            tuple(sweep for sweep in declared.sweeps if sweep.loop in kept),
        )

    def _take_trial(self, trial: int) -> None:
        """The draws of one trial as settings, in place of the whole campaign."""
        assert self.plan is not None
        if not 0 <= trial < self.plan.campaign.trials:
            problem = f"the campaign has trials 0 to {self.plan.campaign.trials - 1}"
            raise InputError("--trial", str(trial), problem, "give one of them")
        plan = replace(self.plan, campaign=replace(self.plan.campaign, compare={}))
        prepared = plan.prepare(plan.campaign.variants()[0])
        drawn = {name: str(value) for name, value in plan.parameters(prepared, trial).items()}
        mine = self.subject.options.set
        self.subject = self.subject.changed(
            parameters=plan.campaign.parameters, set={**plan.campaign.settings, **drawn, **mine}
        )
        self.plan = None

    def run(self) -> StabilityReport:
        """Everything; takes up to a minute or so. Raises InputError, StudyError."""
        begun = time.monotonic()
        points, reports, joint, sweeps = [], [], [], []
        cells: dict[str, list[int]] = {}  # that matter, by point
        provenance: dict = {}
        limits = self.declaration.limits
        for point in self.declaration.points:
            loops = [loop for loop in self.declaration.loops if point.name in loop.points]
            if not loops:
                continue
            with PointStudy(self.subject, point, loops) as study:
                study.linearise()
                here = [self._loop(study, name.name, limits) for name in study.channels]
                joint += [found for loop in loops if (found := study.joint(loop, limits)) is not None]
                points.append(study.report())
                provenance = provenance or study.bench.simulation.provenance()
                step = study.prepared.step
                if study.linear is not None:
                    cells[point.name] = study.linear.cells
            if point.name in cells:
                self._vary(point, loops, here, step, cells[point.name])
            reports += here
        for sweep in self.declaration.sweeps:
            if sweep.point not in cells:
                continue  # the point's loops say why there is no linear model
            point = next(item for item in self.declaration.points if item.name == sweep.point)
            loop = next(item for item in self.declaration.loops if item.name == sweep.loop)
            sweeps.append(swept(self.subject, point, loop, sweep, limits, cells[sweep.point]))
        return StabilityReport(
            system=self.archive.name,
            provenance=provenance,
            limits=asdict(limits),
            points=tuple(points),
            loops=tuple(reports),
            joint=tuple(joint),
            sweeps=tuple(sweeps),
            seconds=time.monotonic() - begun,
        )

    def _loop(self, point: PointStudy, name: str, limits: Limits) -> LoopReport:
        """One channel by both routes, with its amplitudes and elements."""
        channel = next(channel for channel in point.channels if channel.name == name)
        study: LoopStudy = point.loop_study(channel, limits)
        study.measure()
        others = [item.name for item in point.channels if item is not channel]
        report = study.report(others)
        crossings = [crossing.frequency for crossing in report.classical.phase]
        found = study.amplitudes(min(crossings, default=0.1 * study.nyquist))
        if found is not None:
            report.amplitudes, report.amplitude_frequency = found
        loop = next(loop for loop in self.declaration.loops if loop.name == channel.loop)
        assessment, response = study.assessed
        low, high = assessment.curve.frequency[0], assessment.curve.frequency[-1]

        def prepare(use: Mapping[str, str]) -> PreparedSystem:
            return self.subject.at(point.point, use)

        report.nonlinearities = tuple(
            element_report(element, channel, channel.unit, response, low, high, prepare) for element in loop.elements
        )
        return report

    def _vary(
        self, point: Point, loops: Sequence[Loop], reports: Sequence[LoopReport], step: float, cells: Sequence[int]
    ) -> None:
        """What needs route A with something changed: the step, the campaign."""
        steps = sampled(self.subject, point, loops, step, cells)
        spread: dict[str, Dispersion] = {}
        if self.plan is not None:
            spread = dispersed(self.subject, self.plan, point, loops, self.declaration.limits, cells, self._replay)
        for report in reports:
            report.sampling = tuple(steps.get(report.name, ()))
            report.dispersion = spread.get(report.name)

    def _replay(self, channel: str, trial: int) -> str:
        """The command that studies one trial of one loop again."""
        assert self.plan is not None
        assert self.campaign is not None
        words = ["perilune", "stability", self.subject.system, "--campaign", self.campaign]
        words += ["--trial", str(trial), "--seed", str(self.plan.campaign.seed)]
        words += ["--loop", channel.partition("[")[0]]
        for slot, fmu in self.subject.options.use.items():
            words += ["--use", f"{slot}={fmu}"]
        for name in self.subject.options.parameters:
            words += ["--parameters", name]
        for name, value in self.subject.options.set.items():
            words += ["--set", f"{name}={value}"]
        return shlex.join(words)


def _loop_remedy(declared: Mapping[str, Loop]) -> str:
    if not declared:
        return "it names none; cut one with COMPONENT.CONNECTOR"
    return f"{suggestion('', declared)}, or cut one with COMPONENT.CONNECTOR"
