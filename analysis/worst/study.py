"""The worst that a campaign's draws allow: within a box of them, every point a flight."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..campaign.draw_space import DrawSpace
from ..campaign.plan import BatchPlan
from ..errors import InputError
from ..samples.flights import SampleFlights
from ..samples.flown import Flown
from .metric import badness_of
from .outcome import WorstResult
from .search import LEAST, largest

FLIGHTS = 2000
SIGMAS = 3.0
RANDOM = 0.2  # of the flights are random trials, which the worst is told beside


def worst_case(
    plan: BatchPlan,
    metric: str | None = None,
    *,
    sigmas: float = SIGMAS,
    flights: int = FLIGHTS,
    hold: Mapping[str, float] | None = None,
    noise_trial: int = 0,
    workers: int | None = None,
) -> WorstResult:
    """The draws that make an expression largest, within ``sigmas`` of normal draws and the ends of others.

    ``metric`` is over metrics and draws, by default the margin by which a trial is no success. ``hold`` and
    ``noise_trial`` are as in `rare_failure`. A fifth of the ``flights`` are random trials, to begin with and to compare
    with. The campaign's seed is that of the search; ``workers`` does not change the result. Raises InputError.
    """
    if flights < LEAST:
        raise InputError("--flights", str(flights), "too few", f"give {LEAST} or more")
    if not 0.0 < sigmas < 20.0:
        raise InputError("--sigmas", f"{sigmas:g}", "no such box", "give a number above 0, such as 3")
    space = DrawSpace(plan.campaign, hold)
    badness = badness_of(plan.campaign, metric)
    flown = Flown()
    random = np.random.Generator(np.random.Philox(np.random.SeedSequence(plan.campaign.seed)))
    with SampleFlights(
        plan, space.from_box(np.full((1, space.size), 0.5), sigmas), noise_trial=noise_trial, workers=workers
    ) as flights_of:

        def fly(places: np.ndarray, columns: Mapping[str, np.ndarray]) -> np.ndarray:
            trials, draws = flights_of.fly(dict(columns))
            values = badness({**draws, **trials.metrics}, trials.flown)
            flown.add(places, draws, trials.metrics, values)
            return values

        own = space.from_normals(random.standard_normal((int(RANDOM * flights), space.size)))
        places = space.to_box(own, sigmas)
        values = fly(places, own)
        inside = np.all((places >= 0.0) & (places <= 1.0), axis=1)
        if not inside.any():
            problem = f"none of {len(values)} random trials is within {sigmas:g} sigmas in all draws"
            raise InputError("--sigmas", f"{sigmas:g}", problem, "give more")
        found = largest(
            lambda points: fly(points, space.from_box(points, sigmas)),
            places[inside],
            values[inside],
            flights - len(values),
            random,
        )
        return WorstResult(
            badness, sigmas, found[1], found[0], int(np.argmax(values)), len(values), space, flown.whole(),
            flights_of.facts, flights_of.noise(), noise_trial,
        )  # fmt: skip
