"""Rare failure of a campaign: its probability by subset simulation of draws and noise, one simulation per point."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ....common.errors import InputError
from ...campaigns.definition.plan import BatchPlan
from ..draw_space import DrawSpace
from ..failure import failure_of
from ..flown import Flown
from ..sample_flights import SampleFlights
from ..study_units import units_of
from .conditional_sampling import Points
from .outcome import RareOutcome
from .subset_simulation import StalledLevelError, subset_simulation

SAMPLES = 4500  # samples of a level: the interval at 1e-4 is a factor 1.3 to either side
LEAST = 1e-9


def rare_failure(
    plan: BatchPlan,
    failure: str | None = None,
    *,
    hold: Mapping[str, float] | None = None,
    noise_trial: int | None = None,
    samples: int = SAMPLES,
    least: float = LEAST,
    workers: int | None = None,
) -> RareOutcome:
    """Compute the probability of a failure over a campaign's draws and its components' noise. Raises InputError.

    ``failure`` is an expression over metrics and draws, by default that a trial does not succeed. ``hold`` fixes draws
    at one value, which choices and grids require. The noise is random, with a source for each component that generates
    random numbers, unless all simulations have the noise of the campaign's trial ``noise_trial``. Every level has
    ``samples`` points; the search stops below a probability of ``least``. The points are drawn with the campaign's
    seed; ``workers`` does not change the result.
    """
    if samples < 100:
        raise InputError("`samples`", str(samples), "too few", "give 100 or more")
    if not 0.0 < least < 1.0:
        raise InputError("`least`", f"{least:g}", "not a probability", "give a number between 0 and 1")
    space = DrawSpace(plan.campaign, hold, may_be_empty=True)
    requested = failure_of(plan.campaign, failure)
    flown = Flown()
    with SampleFlights(
        plan, space.from_normals(np.zeros((1, space.size))), noise_trial=noise_trial, workers=workers
    ) as flights:
        noise = flights.noise
        if not noise.sources:
            space.check_varies()

        def margin(points: Points) -> np.ndarray:
            trials, draws = flights.fly(space.from_normals(points.draws), noise.of(points.streams))
            margins = requested.margins({**draws, **trials.metrics}, trials.flown)
            flown.add(points.draws, draws, trials.metrics, margins)
            return margins

        try:
            simulation = subset_simulation(
                margin, space.size, len(noise.sources), seed=plan.campaign.seed, samples=samples, least=least
            )
        except StalledLevelError as stuck:
            worth, fraction = stuck.args
            simulations = f"{100 * fraction:.0f} % of a level's simulations"
            problem = f"{simulations} have the same margin, {worth:g}, and none has a smaller margin"
            where = ("`failure`", failure) if failure is not None else (plan.campaign.file, "success")
            raise InputError(*where, problem, "use a failure condition whose margin varies continuously") from stuck
        units = units_of(space, flights.prepared, flights.facts)
        return RareOutcome(
            failure=requested, simulation=simulation, samples=samples, space=space, flown=flown.whole(),
            facts=flights.facts, noise=noise, units=units, lost=flights.lost,
        )  # fmt: skip
