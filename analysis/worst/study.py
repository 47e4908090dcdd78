"""The worst that a campaign's draws allow: within a box of them, every point a flight."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from ..campaign.draw_space import DrawSpace
from ..campaign.drawing.declared import Columns
from ..campaign.plan import BatchPlan
from ..errors import InputError
from ..samples.flights import SampleFlights
from ..samples.flown import Flown
from .asked import MarginAsked
from .margin import SIZES, badness_of_margin
from .margin_studies import MarginStudies
from .metric import Badness, badness_of
from .outcome import WorstResult
from .search import LEAST, Phase, largest

FLIGHTS = 2000
STUDIES = 500  # a margin costs more than a flight
MARGIN = "disk"
SIGMAS = 3.0
RANDOM = 0.2  # of the flights are random trials, which the worst is told beside


class Flights(Protocol):
    """Who flies draws, or studies them; ``fly`` gives what they come to, and the drawn and derived values."""

    facts: dict[str, Any]

    def fly(self, columns: Columns) -> tuple[Sampled, Mapping[str, np.ndarray]]: ...
    def noise(self) -> str: ...


class Sampled(Protocol):
    """What draws come to: columns (draws,) by name, and of which there is anything (draws,)."""

    @property
    def metrics(self) -> Mapping[str, np.ndarray]: ...
    @property
    def flown(self) -> np.ndarray: ...


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
    box = _Box(plan, sigmas, flights, hold)
    badness = badness_of(plan.campaign, metric)
    with SampleFlights(plan, box.middle, noise_trial=noise_trial, workers=workers) as flights_of:
        return box.searched(flights_of, badness, noise_trial)


def worst_margin(
    asked: MarginAsked,
    margin: str = MARGIN,
    *,
    sigmas: float = SIGMAS,
    flights: int = STUDIES,
    hold: Mapping[str, float] | None = None,
    noise_trial: int = 0,
    workers: int | None = None,
) -> WorstResult:
    """The draws that make the least margin of a loop's channels smallest, in the box of `worst_case`.

    ``margin`` is one of `SIZES`. An unstable loop is worse than any margin, by its largest multiplier; draws that
    cannot be studied are the worst there is. The rest is as in `worst_case`. Raises InputError.
    """
    if margin not in SIZES:
        raise InputError("--margin", margin, "no such margin", f"give {', '.join(SIZES)}")
    box = _Box(asked.plan, sigmas, flights, hold)
    with MarginStudies(asked, box.middle, noise_trial=noise_trial, workers=workers) as studies:
        badness = badness_of_margin(asked.loop.name, asked.point.name, studies.channels, margin)
        found = box.searched(studies, badness, noise_trial)
        return replace(found, reason=studies.reasons[found.places[0]], again=asked.replay)


class _Box:
    """Where is searched, and with how many flights. Raises InputError."""

    def __init__(self, plan: BatchPlan, sigmas: float, flights: int, hold: Mapping[str, float] | None) -> None:
        if flights < LEAST:
            raise InputError("--flights", str(flights), "too few", f"give {LEAST} or more")
        if not 0.0 < sigmas < 20.0:
            raise InputError("--sigmas", f"{sigmas:g}", "no such box", "give a number above 0, such as 3")
        self._space = DrawSpace(plan.campaign, hold)
        self._sigmas, self._flights, self._seed = sigmas, flights, plan.campaign.seed

    @property
    def middle(self) -> Columns:
        return self._space.from_box(np.full((1, self._space.size), 0.5), self._sigmas)

    def searched(self, flights_of: Flights, badness: Badness, noise_trial: int) -> WorstResult:
        """The worst of random trials and of a search from them. Raises InputError."""
        space, sigmas, flown = self._space, self._sigmas, Flown()
        random = np.random.Generator(np.random.Philox(np.random.SeedSequence(self._seed)))

        def fly(places: np.ndarray, columns: Mapping[str, np.ndarray]) -> np.ndarray:
            trials, draws = flights_of.fly(dict(columns))
            values = badness({**draws, **trials.metrics}, trials.flown)
            flown.add(places, draws, trials.metrics, values)
            return values

        own = space.from_normals(random.standard_normal((int(RANDOM * self._flights), space.size)))
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
            self._flights - len(values),
            random,
        )
        return WorstResult(
            badness, sigmas, found[1], found[0], int(np.argmax(values)), len(values), space, flown.whole(),
            flights_of.facts, flights_of.noise(), noise_trial,
            phases=(Phase("random trials", len(values)), *found.phases),
        )  # fmt: skip
