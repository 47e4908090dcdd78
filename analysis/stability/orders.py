"""Both orders of a study whose loops contain an FMU with undeclared dependencies: without and with its feedthrough.

A component without feedthrough is stepped with the inputs of t_n, a component with feedthrough with the inputs of
t_(n+1). The actual effect of inputs within a step is between the two, so the margins of both orders bracket the true
margins as far as these depend on the step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from ...common.errors import InputError
from ..runtime.system.prepared import PreparedSystem
from ..runtime.system.schedule import origin
from .point.bench import StudyError
from .request.request import Request, Subject
from .results.report import FailedStudy, JointReport, LoopReport, Orders, StabilityStudy
from .results.requirement import MarginRequirement, MarginVerdict
from .results.varied import Dispersion

# notes of requirements without a verdict
NOT_STUDIED, DIFFERENT = "not studied", "not known, since linearised and measured responses differ"
Judgeable = LoopReport | JointReport | Dispersion


def study_both_orders(request: Request, make: Callable[[Request], StabilityStudy]) -> StabilityStudy:
    """Run the study ``make`` of a request, in both orders if a loop contains an undeclared FMU.

    With several such FMUs the extremes are studied: none with feedthrough, as simulated, and all with feedthrough. If
    feedthrough of all would close an algebraic loop, the components at which the initialisation cuts this loop stay
    without it. Sweeps and nonlinear elements are studied in the simulated order only. If no simulation with feedthrough
    can be studied, the verdicts of the simulated order are withheld. Raises the errors of ``make`` for the request.
    """
    report = make(request)
    subject = Subject(request.system, request.options)
    points = [point for point in request.declaration.points if request.loops_at(point)]
    fmus: dict[str, str] = {}
    cuts: dict[str, None] = {}
    for point in points:
        prepared = subject.at(point)
        feedthrough = prepared.schedule.feedthrough
        on_loops = _on_loops(prepared)
        fmus |= {name: prepared.network.fmus[name].name for name in feedthrough.undeclared if name in on_loops}
        cuts |= dict.fromkeys(feedthrough.cuts)
    if not fmus or prepared.algorithm != "sequential":  # Jacobi's algorithm has only one order
        return report
    without: list[str] = []
    direct = list(fmus)
    if not _can_be_direct(subject, request, direct):
        without = [name for name in fmus if any(cut.partition(" -> ")[2].startswith(f"{name}.") for cut in cuts)]
        direct = [name for name in fmus if name not in without]
    other: StabilityStudy | None = None
    if direct and _can_be_direct(subject, request, direct):
        options = request.options.replace(feedthrough=(*request.options.chosen["feedthrough"], *direct))
        loops = tuple(replace(loop, elements=()) for loop in request.declaration.loops)
        declaration = replace(request.declaration, loops=loops, sweeps=())
        try:
            other = make(replace(request, options=options, declaration=declaration))
        except StudyError as error:
            lost = tuple(FailedStudy(report.system, point.name, "system", str(error)) for point in report.points)
            other = replace(report, loops=(), joint=(), sweeps=(), unstudied=lost)
    else:
        direct, without = [], list(fmus)
    orders = Orders(fmus, tuple(direct), tuple(without), tuple(cuts), other)
    return _merge_verdicts(report, orders)


def _can_be_direct(subject: Subject, request: Request, names: Sequence[str]) -> bool:
    """Return True if components can all have feedthrough without closing an algebraic loop."""
    options = subject.options.replace(feedthrough=(*subject.options.chosen["feedthrough"], *names))
    trial = replace(subject, options=options)
    try:
        for point in request.declaration.points:
            trial.at(point)
    except InputError:  # not of the system itself, which was prepared before
        return False
    return True


def _on_loops(prepared: PreparedSystem) -> set[str]:
    """Return the components whose outputs return to them through connections."""
    readers: dict[str, set[str]] = {}
    for link in prepared.network.links():
        start = origin(prepared.network, link).component
        if start is not None and link.target.component is not None and not link.is_parameter:
            readers.setdefault(start, set()).add(link.target.component)
    looped = set()
    for component in readers:
        visited: set[str] = set()
        queue = list(readers[component])
        while queue:
            current = queue.pop()
            if current not in visited:
                visited.add(current)
                queue += readers.get(current, ())
        if component in visited:
            looped.add(component)
    return looped


def _merge_verdicts(report: StabilityStudy, orders: Orders) -> StabilityStudy:
    """Return the report with the requirements of both orders, if there are two."""
    if orders.report is None:
        return replace(report, orders=orders)
    loops = {(loop.name, loop.point): loop for loop in orders.report.loops}
    joints = {(joint.name, joint.point): joint for joint in orders.report.joint}
    return replace(
        report,
        loops=tuple(_loop(loop, loops.get((loop.name, loop.point))) for loop in report.loops),
        joint=tuple(
            replace(joint, requirements=_both(joint, joints.get((joint.name, joint.point)))) for joint in report.joint
        ),
        unstudied=tuple(_withhold_verdict(lost, orders.report) for lost in report.unstudied),
        orders=orders,
    )


def _withhold_verdict(lost: FailedStudy, other: StabilityStudy) -> FailedStudy:
    """Withhold the verdict on a loop that fails without margins in only one order."""
    here = (lost.name, lost.point)
    fails = any((each.name, each.point) == here and each.verdict is MarginVerdict.FAIL for each in other.unstudied)
    unstable = any((loop.name, loop.point) == here and loop.margins.unstable for loop in other.loops)
    if lost.verdict is not MarginVerdict.FAIL or fails or unstable:
        return lost
    return replace(lost, verdict=MarginVerdict.WITHHELD)


def _loop(loop: LoopReport, other: LoopReport | None) -> LoopReport:
    """Return a loop with the requirements of both orders.

    If the linearised and measured responses differ in the other order, nothing passes.
    """
    note = "" if other is None or not other.is_contradicted else DIFFERENT
    judged = replace(loop, requirements=_both(loop, other, note))
    if loop.dispersion is not None:
        spread = None if other is None else other.dispersion
        judged.dispersion = replace(loop.dispersion, requirements=_both(loop.dispersion, spread, note))
    return judged


def _both(one: Judgeable, another: Judgeable | None, note: str = "") -> tuple[MarginRequirement, ...]:
    """Return the requirements of one order, each with the same requirement in the other order."""
    by_title = {} if another is None else {other.title: other for other in another.requirements}
    paired = []
    for item in one.requirements:
        other = by_title.get(item.title) or replace(item, value=None, passed=None, note=NOT_STUDIED)
        if note and other.passed:
            other = replace(other, passed=None, note=note)
        paired.append(replace(item, as_feedthrough=other))
    return tuple(paired)
