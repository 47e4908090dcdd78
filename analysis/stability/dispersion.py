"""Margins over the trials of a campaign."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from ..campaigns.definition.plan import BatchPlan
from .loops.margin_values import LoopMargins, MarginQuantity
from .point.bench import OperatingPoint
from .point.linearise import linearise
from .point.point_study import PointStudy
from .point.responses import ONE_STEP, LoopModel, loop_model
from .request.declaration import LoopDeclaration, MarginLimits, PointDeclaration
from .request.request import Subject
from .results.requirement import MarginRequirement, Scope
from .results.varied import Dispersion


def disperse(
    subject: Subject,
    plan: BatchPlan,
    point: PointDeclaration,
    loops: Sequence[LoopDeclaration],
    limits: MarginLimits,
    cells: Sequence[int],
    replay: Callable[[str, int], str],
    tell: Callable[[int, int], None],
) -> dict[str, Dispersion]:
    """Compute margins of every channel over the trials of a campaign, each linearised about its simulation.

    The campaign's draws, seeds and streams are used at the point. ``cells`` are the numbers of the relevant memory
    cells; ``replay`` returns the command that repeats the study of one loop in one trial. Raises InputError,
    StudyError.
    """
    tell(plan.campaign.trials, 0)
    (variant,) = plan.campaign.variants()
    flown = subject.with_options(campaign=plan.campaign.layer_of(variant))
    rows: dict[str, list[LoopMargins]] = {}
    poles: dict[str, list[np.ndarray]] = {}
    with PointStudy(flown, point, loops, vary(plan)) as study:
        for trial in range(plan.campaign.trials):
            for name, model in models_of_trial(study, plan, trial, cells).items():
                rows.setdefault(name, []).append(model.margins())
                poles.setdefault(name, []).append(model.poles)
            tell(0, 1)
        loop_of = {channel.name: channel.loop for channel in study.channels}
    return {
        name: _dispersion(plan, items, np.concatenate(poles[name]), limits, partial(replay, loop_of[name]))
        for name, items in rows.items()
    }


def models_of_trial(study: PointStudy, plan: BatchPlan, trial: int, cells: Sequence[int]) -> dict[str, LoopModel]:
    """Return the model of every channel's loop with the draws of one trial.

    The system of ``study`` includes the campaign's layer. Raises InputError, StudyError.
    """
    study.bench.set(plan.parameters(study.prepared, trial))
    start = OperatingPoint(study.bench)
    try:
        linear = linearise(start, cells, ONE_STEP)
    finally:
        start.release()
    return {port.channel.name: loop_model(linear, port) for port in linear.model.ports}


def vary(plan: BatchPlan) -> list[str]:
    """Return the names of the parameters that trials of a campaign set."""
    (variant,) = plan.campaign.variants()
    prepared = plan.prepare(variant)
    return sorted(plan.parameters(prepared, 0))


def _dispersion(
    plan: BatchPlan, items: Sequence[LoopMargins], poles: np.ndarray, limits: MarginLimits, replay: Callable[[int], str]
) -> Dispersion:
    # the trial with the least disk margin, or among unstable loops with the largest multiplier
    worst = min(
        range(len(items)), key=lambda place: (items[place].size(MarginQuantity.DISK), -(items[place].largest or 0.0))
    )
    unstable = sum(item.unstable for item in items)
    note = f"{unstable} of {len(items)} trials unstable; replay the worst: {replay(worst)}" if unstable else ""
    fraction = MarginRequirement(
        Scope.DISPERSED, MarginQuantity.STABILITY, 1.0 - unstable / len(items), 1.0, unstable == 0, note
    )
    required = {
        MarginQuantity.GAIN: limits.dispersed_gain_margin_db,
        MarginQuantity.PHASE: limits.dispersed_phase_margin_deg,
    }
    minimum = [
        MarginRequirement.at_least(Scope.DISPERSED, quantity, min(item.size(quantity) for item in items), limit)
        for quantity, limit in required.items()
    ]
    return Dispersion(
        campaign=plan.campaign.file,
        margins=tuple(items),
        poles=poles,
        worst=worst,
        replay=replay(worst),
        requirements=(fraction, *minimum),
    )
