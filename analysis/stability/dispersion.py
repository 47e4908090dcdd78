"""Margins over the trials of a campaign."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from analysis.batch.plan import BatchPlan

from .declaration import Limits, Loop, Point
from .followed import ONE_STEP, Margins, margins_of
from .linearise import linearise
from .operating_point import OperatingPoint
from .point_study import PointStudy
from .results import Dispersion, Requirement
from .subject import Subject


def dispersed(
    subject: Subject,
    plan: BatchPlan,
    point: Point,
    loops: Sequence[Loop],
    limits: Limits,
    cells: Sequence[int],
    replay: Callable[[str, int], str],
) -> dict[str, Dispersion]:
    """Margins of every channel over the trials of a campaign, each linearised on its own flight.

    The campaign's draws, seeds and streams are flown at the point.
    ``cells`` is the memory that matters at the point; ``replay`` gives the command that studies one trial of one loop
    again. Raises InputError, StudyError.
    """
    flown = subject.changed(parameters=plan.campaign.parameters)
    flown = replace(flown, options=replace(flown.options, set={**plan.campaign.settings, **flown.options.set}))
    rows: dict[str, list[Margins]] = {}
    with PointStudy(flown, point, loops, _varied(plan)) as study:
        for trial in range(plan.campaign.trials):
            study.bench.set(plan.parameters(study.prepared, trial))
            start = OperatingPoint(study.bench)
            try:
                linear = linearise(start, cells, ONE_STEP)
            finally:
                start.release()
            for channel in study.channels:
                rows.setdefault(channel.name, []).append(margins_of(linear, channel.name))
        loop_of = {channel.name: channel.loop for channel in study.channels}
    return {name: _dispersion(plan, items, limits, partial(replay, loop_of[name])) for name, items in rows.items()}


def _varied(plan: BatchPlan) -> list[str]:
    prepared = plan.prepare(plan.campaign.variants()[0])
    return sorted(plan.parameters(prepared, 0))


def _dispersion(plan: BatchPlan, items: list[Margins], limits: Limits, replay: Callable[[int], str]) -> Dispersion:
    disks = np.array([item.disk if item.stable else 0.0 for item in items])
    worst = int(np.argmin(disks))
    stable = all(item.stable for item in items)
    gain = min(item.gain_db for item in items)
    phase = min(item.phase_deg for item in items)
    shown = (float(gain) if np.isfinite(gain) else None, float(phase) if np.isfinite(phase) else None)
    wanted = (
        Requirement("dispersed stability", float(np.mean([item.stable for item in items])), 1.0, "1", stable),
        Requirement(
            "dispersed gain margin",
            shown[0],
            limits.dispersed_gain_margin_db,
            "dB",
            stable and gain >= limits.dispersed_gain_margin_db,
        ),
        Requirement(
            "dispersed phase margin",
            shown[1],
            limits.dispersed_phase_margin_deg,
            "deg",
            stable and phase >= limits.dispersed_phase_margin_deg,
        ),
    )
    return Dispersion(
        campaign=plan.campaign.file,
        trials=len(items),
        gain_margin=np.array([item.gain if item.stable and np.isfinite(item.gain) else np.nan for item in items]),
        phase_margin=np.array([item.phase if item.stable and np.isfinite(item.phase) else np.nan for item in items]),
        modulus_margin=np.array([item.modulus if item.stable else np.nan for item in items]),
        disk_margin=np.array([item.disk if item.stable else np.nan for item in items]),
        stable=np.array([item.stable for item in items]),
        poles=np.concatenate([item.poles for item in items]),
        worst=worst,
        replay=replay(worst),
        requirements=wanted,
    )
