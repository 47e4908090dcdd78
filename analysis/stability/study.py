"""Complete study of a system's stability: its points, loops, sweeps and campaign, in one report."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import chdir
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

from ...common.errors import InputError
from ...common.family.pools import process_pool
from ..campaigns.execute.workers import worker_count
from ..runtime.system.options import Layer
from ..runtime.system.prepared import PreparedSystem
from .dispersion import disperse
from .orders import study_both_orders
from .point.bench import LoopError, StudyError
from .point.frozen_plan import check_frozen_plan
from .point.limit_cycles import element_report
from .point.point_study import PointStudy
from .progress import Tell, begin, listen, show_progress, tell_parent
from .request.channels import Channel
from .request.declaration import PointDeclaration
from .request.request import Request, Subject
from .results.report import FailedStudy, JointReport, LoopReport, PointReport, StabilityStudy
from .results.varied import Dispersion
from .variation import run_sweep, vary_step

Replay = Callable[[Request, str, int], str]  # the command that studies a loop again, at one trial of the campaign


@dataclass
class PointResult:
    """Result of the study of one point; ``cells`` are the relevant memory cells, None if there is no linear model."""

    report: PointReport
    loops: list[LoopReport]
    joint: list[JointReport]
    unstudied: list[FailedStudy]
    cells: list[int] | None
    provenance: dict[str, Any]


def study(request: Request, replay: Replay, workers: int | None = None) -> StabilityStudy:
    """Study all parts of a request, with points in parallel in ``workers`` processes (None: one per processor).

    Both orders of FMUs with undeclared dependencies are studied if necessary. The report does not depend on the number
    of workers. ``replay`` is a function that other processes can import. Raises InputError, and StudyError if no
    simulation reaches a point.
    """
    with chdir(Path.cwd()), show_progress() as report:  # an FMU may change the folder
        count = worker_count(workers)
        return study_both_orders(request, lambda each: _study(each, replay, count, report))


def _study(request: Request, replay: Replay, count: int, tell: Tell) -> StabilityStudy:
    begun = time.monotonic()
    points = [point for point in request.declaration.points if request.loops_at(point)]
    if min(count, len(points)) > 1:
        with (
            listen(tell) as pipe,
            process_pool(min(count, len(points)), begin, pipe) as pool,
        ):
            results = list(pool.map(partial(study_point, request, replay, tell=tell_parent), points))
    else:
        results = [study_point(request, replay, point, tell) for point in points]
    cells = {point.name: result.cells for point, result in zip(points, results, strict=True)}
    unstudied = [item for result in results for item in result.unstudied]
    sweeps = []
    for sweep in request.declaration.sweeps:
        known = cells[sweep.point]
        has_loop = any(
            (item.loop, item.point) == (sweep.loop, sweep.point) for result in results for item in result.loops
        )
        if known is None or not has_loop:
            unstudied.append(
                FailedStudy(sweep.name, sweep.point, "sweep", "its loop has no linear model at this point")
            )
            continue
        subject = Subject(request.system, request.options)
        loop, point = request.loop(sweep.loop), request.point(sweep.point)
        try:
            sweeps.append(run_sweep(subject, point, loop, sweep, request.declaration.limits, known, tell))
        except StudyError as error:
            unstudied.append(FailedStudy(sweep.name, sweep.point, "sweep", str(error)))
    return StabilityStudy(
        system=request.name,
        provenance=results[0].provenance,
        limits=asdict(request.declaration.limits),
        points=tuple(result.report for result in results),
        loops=tuple(loop for result in results for loop in result.loops),
        joint=tuple(joint for result in results for joint in result.joint),
        sweeps=tuple(sweeps),
        unstudied=tuple(unstudied),
        seconds=time.monotonic() - begun,
    )


def study_point(request: Request, replay: Replay, point: PointDeclaration, tell: Tell) -> PointResult:
    """Study one point with all its loops; each loop and the linear model count as a step of progress.

    Raises InputError, StudyError.
    """
    subject = Subject(request.system, request.options)
    loops, limits = request.loops_at(point), request.declaration.limits
    with PointStudy(subject, point, loops) as work:
        check_frozen_plan(work.prepared, point)
        tell(1 + len(work.channels), 0)
        work.linearise()
        tell(0, 1)
        reports: list[LoopReport] = []
        joint: list[JointReport] = []
        unstudied: list[FailedStudy] = []
        for channel in work.channels:
            try:
                reports.append(_loop(request, subject, work, channel))
            except StudyError as error:
                verdict = error.verdict if isinstance(error, LoopError) else None
                unstudied.append(FailedStudy(channel.name, point.name, "loop", str(error), verdict))
            tell(0, 1)
        lost = {item.name for item in unstudied}
        for loop in loops:
            if any(channel.loop == loop.name and channel.name in lost for channel in work.channels):
                continue
            try:
                joint_report = work.joint(loop, limits)
                joint += [] if joint_report is None else [joint_report]
            except StudyError as error:
                unstudied.append(FailedStudy(loop.name, point.name, "simultaneous margins", str(error)))
        step = work.prepared.step
        result = PointResult(
            report=work.report(),
            loops=reports,
            joint=joint,
            unstudied=unstudied,
            cells=work.linear.cells if work.linear is not None else None,
            provenance=dict(work.bench.simulation.provenance()),
        )
    if result.cells is not None and reports:
        _vary(request, replay, subject, point, reports, step, result.cells, unstudied, tell)
    return result


def _loop(request: Request, subject: Subject, point: PointStudy, channel: Channel) -> LoopReport:
    """Study one channel by linearisation and frequency-response test, with amplitudes and nonlinear elements."""
    work = point.loop_study(channel, request.declaration.limits)
    work.measure()
    work.check_loop()
    work.refine()
    report = work.report([item.name for item in point.channels if item is not channel])
    crossings = [crossing.frequency for crossing in report.classical.phase]
    amplitudes = work.amplitudes(min(crossings, default=0.1 * work.nyquist))
    if amplitudes is not None:
        report.amplitudes, report.amplitude_frequency = amplitudes
    assessment, response = work.assessed
    low, high = assessment.curve.frequency[0], assessment.curve.frequency[-1]

    def prepare(layer: Layer) -> PreparedSystem:
        return subject.at(point.point, layer)

    report.nonlinearities = tuple(
        element_report(element, channel, channel.unit, response, low, high, prepare)
        for element in request.loop(channel.loop).elements
    )
    return report


def _vary(
    request: Request,
    replay: Replay,
    subject: Subject,
    point: PointDeclaration,
    reports: Sequence[LoopReport],
    step: float,
    cells: Sequence[int],
    unstudied: list[FailedStudy],
    tell: Tell,
) -> None:
    """Add results of repeated linearisations: other communication steps, the trials of the campaign."""
    loops = [loop for loop in request.loops_at(point) if any(report.loop == loop.name for report in reports)]
    steps = vary_step(subject, point, loops, step, cells, [report.name for report in reports], tell)
    spread: dict[str, Dispersion] = {}
    if request.plan is not None:
        try:
            limits = request.declaration.limits
            spread = disperse(subject, request.plan, point, loops, limits, cells, partial(replay, request), tell)
        except (StudyError, InputError) as error:  # input was checked before, but a trial may end early
            unstudied.append(FailedStudy(request.campaign or "", point.name, "campaign", str(error)))
    for report in reports:
        report.sampling = steps.get(report.name, ())
        report.dispersion = spread.get(report.name)
