"""Margins again with something changed: the communication step, one parameter, the draws of a campaign."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from analysis.batch.plan import BatchPlan, check_plan
from analysis.cosim.system import SystemOptions
from analysis.errors import InputError

from .assessment import assess, decibel, degrees, lowest_frequency
from .bench import StudyError
from .declaration import Limits, Loop, Point, Sweep
from .linearise import linearise
from .operating_point import OperatingPoint
from .point_study import PointStudy
from .results import Dispersion, Requirement, Sampled, SweepReport
from .routes import loop_model

STEPS = (0.5, 1.0, 2.0)  # of the communication step
SWEPT = 13  # values of a swept parameter
CROSSING = 1e-3  # relative, of a parameter at which a limit is crossed
ONE_STEP = (1e-4,)  # of differences, where a plateau has been seen at the same point already


@dataclass(frozen=True)
class Margins:
    """The few numbers that are followed: factors and angles as in `results`; inf where there is no crossing."""

    gain: float
    phase: float
    modulus: float
    disk: float
    stable: bool
    poles: np.ndarray


def sampled(system: str, options: SystemOptions, point: Point, loops: Sequence[Loop]) -> dict[str, list[Sampled]]:
    """Margins of every channel with half, the same and twice the communication step."""
    with PointStudy(system, options, point, loops) as study:
        step = study.prepared.step
        names = [channel.name for channel in study.channels]
    found: dict[str, list[Sampled]] = {name: [] for name in names}
    for factor in STEPS:
        try:
            with PointStudy(system, replace(options, step=factor * step), point, loops) as study:
                study.linearise()
                if study.linear is None:
                    raise StudyError(study.why_not)
                for channel in study.channels:
                    margins = _margins(study, channel.name)
                    found[channel.name].append(Sampled(factor * step, margins.gain, margins.phase))
        except (InputError, StudyError) as error:
            for name in names:
                found[name].append(Sampled(factor * step, None, None, str(error)))
    return found


def swept(system: str, options: SystemOptions, point: Point, loop: Loop, sweep: Sweep, limits: Limits) -> SweepReport:
    """Margins of a loop's first channel over a parameter, geometric where it is positive."""

    def margins(value: float) -> Margins:
        changed = replace(options, set={**options.set, sweep.parameter: repr(value)})
        with PointStudy(system, changed, point, [loop]) as study:
            study.linearise()
            if study.linear is None:
                raise StudyError(study.why_not)
            return _margins(study, study.channels[0].name)

    spread = np.geomspace if sweep.low > 0.0 else np.linspace
    values = spread(sweep.low, sweep.high, SWEPT)
    found = [margins(float(value)) for value in values]
    wanted: dict[str, Callable[[Margins], float]] = {
        "gain margin": lambda item: _decibel(item) - limits.gain_margin_db,
        "phase margin": lambda item: _degrees(item) - limits.phase_margin_deg,
        "modulus margin": lambda item: item.modulus - limits.modulus_margin,
    }
    crossings = {}
    for name, excess in wanted.items():
        over = [excess(item) if item.stable else -np.inf for item in found]
        for place in reversed(range(len(values) - 1)):
            if (over[place] < 0.0) != (over[place + 1] < 0.0):
                crossings[name] = _crossing(
                    lambda value, excess=excess: excess(margins(value)), *values[place : place + 2]
                )
                break
    return SweepReport(
        name=sweep.name,
        loop=loop.name,
        parameter=sweep.parameter,
        unit=None,
        values=values,
        gain_margin=np.array([item.gain if item.stable else np.nan for item in found]),
        phase_margin=np.array([item.phase if item.stable else np.nan for item in found]),
        crossings=crossings,
    )


def _crossing(excess: Callable[[float], float], low: float, high: float) -> float:
    def bounded(value: float) -> float:
        return float(np.clip(excess(value), -1e3, 1e3))

    return float(brentq(bounded, low, high, rtol=CROSSING, xtol=CROSSING * abs(high)))


def dispersed(
    plan: BatchPlan, point: Point, loops: Sequence[Loop], limits: Limits, replay: Callable[[str, int], str]
) -> dict[str, Dispersion]:
    """Margins of every channel over the trials of a campaign, each linearised on its own flight.

    The campaign's draws, seeds and streams are flown at the point; its comparison of FMUs is left out.
    ``replay`` gives the command that studies one trial of one loop again.
    """
    plan = replace(plan, campaign=replace(plan.campaign, compare={}))
    check_plan(plan)
    options = replace(
        plan.options,
        parameters=(*plan.campaign.parameters, *plan.options.parameters),
        set={**plan.campaign.settings, **plan.options.set},
    )
    rows: dict[str, list[Margins]] = {}
    varied = _varied(plan)
    with PointStudy(plan.system, options, point, loops, varied) as study:
        cells = None
        for trial in range(plan.campaign.trials):
            study.bench.set(plan.parameters(study.prepared, trial))
            start = OperatingPoint(study.bench)
            study.linear = linearise(start, cells, ONE_STEP)
            cells = study.linear.cells
            start.release()
            for channel in study.channels:
                rows.setdefault(channel.name, []).append(_margins(study, channel.name))
    return {name: _dispersion(plan, name, items, limits, replay) for name, items in rows.items()}


def _varied(plan: BatchPlan) -> list[str]:
    prepared = plan.prepare(plan.campaign.variants()[0])
    return sorted(plan.parameters(prepared, 0))


def _dispersion(
    plan: BatchPlan, name: str, items: list[Margins], limits: Limits, replay: Callable[[str, int], str]
) -> Dispersion:
    disks = np.array([item.disk if item.stable else 0.0 for item in items])
    worst = int(np.argmin(disks))
    stable = all(item.stable for item in items)
    gain = min(_decibel(item) for item in items)
    phase = min(_degrees(item) for item in items)
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
        gain_margin=np.array([item.gain if np.isfinite(item.gain) else np.nan for item in items]),
        phase_margin=np.array([item.phase if np.isfinite(item.phase) else np.nan for item in items]),
        modulus_margin=np.array([item.modulus for item in items]),
        disk_margin=np.array([item.disk for item in items]),
        stable=np.array([item.stable for item in items]),
        poles=np.concatenate([item.poles for item in items]),
        worst=worst,
        replay=replay(name, worst),
        requirements=wanted,
    )


def _margins(study: PointStudy, name: str) -> Margins:
    assert study.linear is not None
    port = next(port for port in study.linear.model.ports if port.channel.name == name)
    model = loop_model(study.linear, port)
    low = lowest_frequency(model.response, port.seconds)
    found = assess(model.response, low, np.pi / port.seconds, port.seconds, None)
    gain, phase = found.classical.gain_margin, found.classical.phase_margin
    return Margins(
        gain=gain.value if gain else np.inf,
        phase=phase.value if phase else np.inf,
        modulus=found.robust.modulus_margin,
        disk=found.robust.disk_margin,
        stable=model.stable,
        poles=np.array([mode.z for mode in model.modes if mode.kind == "loop"]),
    )


def _decibel(item: Margins) -> float:
    return decibel(item.gain) if np.isfinite(item.gain) else np.inf


def _degrees(item: Margins) -> float:
    return degrees(item.phase) if np.isfinite(item.phase) else np.inf
