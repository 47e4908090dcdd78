"""What drives the metrics of a campaign: Sobol' indices of a plan of their own."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ...campaigns.spec.draw_space import DrawSpace
from ...campaigns.spec.plan import BatchPlan
from ...common.elementary import elementary
from ...common.errors import InputError
from ..evaluation.flights import SampleFlights
from ..evaluation.flown import Flown
from ..evaluation.units import units_of
from .outcome import SensitivityResult
from .ranks import rank_correlations
from .sobol import indices, saltelli_points, with_noise

SUCCESS = "success"
EDGE = 2.0**-40  # of the unit interval, where a normal draw would be infinite


def sensitivity(
    plan: BatchPlan,
    base: int,
    *,
    hold: Mapping[str, float] | None = None,
    noise_trial: int | None = None,
    workers: int | None = None,
    tell: Callable[[str], object] = lambda price: None,
) -> SensitivityResult:
    """First-order and total Sobol' indices of every metric and of success, by ``base`` * (draws + 3) flights.

    The noise of all components is one input beside the draws, unless ``noise_trial`` gives all flights the same: then,
    and where no component has any, it is ``base`` * (draws + 2) flights.
    ``base`` is a power of two, 32 or more; draws that are jointly normal are refused, as their shares cannot be told
    apart: hold them. ``hold`` and ``noise_trial`` are as in `rare_failure`. ``tell`` is given the price before anything
    flies. The campaign's seed is that of the points; ``workers`` does not change the result. Raises InputError.
    """
    if base < 32 or base & (base - 1):
        raise InputError("`base`", str(base), "not a power of two from 32 on", "give 64, 128, 256, ...")
    space = DrawSpace(plan.campaign, hold)
    if not space.independent:
        draw = next(draw for draw in plan.campaign.draws if len(draw.names) > 1 and draw.names[0] in space.names)
        problem = "jointly normal values have no indices of their own"
        held = " ".join(f"`hold` {name}=VALUE" for name in draw.names)
        raise InputError(plan.campaign.file, f"draw.{draw.name}", problem, f"hold them: {held}")
    random = np.random.Generator(np.random.Philox(np.random.SeedSequence(plan.campaign.seed)))
    with SampleFlights(
        plan, space.from_normals(np.zeros((1, space.size))), noise_trial=noise_trial, workers=workers
    ) as flights:
        noise = flights.noise
        extra = 3 if noise.sources else 2
        tell(f"sensitivity: {base} x ({space.size} draws + {extra}) = {base * (space.size + extra)} flights")
        points, streams = saltelli_points(base, space.size, random), np.zeros(0, dtype=np.int64)
        if noise.sources:
            points, streams = with_noise(points, base)
        columns = space.from_normals(elementary("normal_quantile")(np.clip(points, EDGE, 1.0 - EDGE)))
        trials, draws = flights.fly(columns, noise.same(streams))
        metrics = {**trials.metrics, SUCCESS: trials.success.astype(float)}
        reported = [name for name, values in metrics.items() if np.all(np.isfinite(values)) and np.ptp(values) > 0.0]
        computed = indices(np.array([metrics[name] for name in reported]), base, random) if reported else None
        independent = slice(0, 2 * base)  # A and B
        sampled = {name: draws[name][independent] for name in space.names}
        ranks = rank_correlations(sampled, {name: values[independent] for name, values in metrics.items()})
        flown = Flown()
        flown.add(points, draws, trials.metrics, metrics[SUCCESS])
        return SensitivityResult(
            base, space, tuple(reported), computed, _untold(metrics, reported), ranks, flown.whole(), flights.facts,
            noise, units_of(space, flights.prepared, flights.facts),
        )  # fmt: skip


def _untold(metrics: Mapping[str, np.ndarray], told: list[str]) -> dict[str, str]:
    """Why numbers have no indices."""
    reasons = {}
    for name, values in metrics.items():
        if name not in told:
            lacking = int(np.sum(~np.isfinite(values)))
            reasons[name] = f"not finite in {lacking} flights" if lacking else f"{values[0]:g} in all flights"
    return reasons
