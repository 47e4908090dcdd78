"""Search for the worst case of a campaign's draws within a box, with one simulation or stability study per point."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Protocol, TypedDict, Unpack

import numpy as np

from ....common.errors import InputError
from ...campaigns.definition.plan import BatchPlan
from ...campaigns.draws.generators import standard_normals
from ...campaigns.draws.interfaces import Columns, input_names
from ...campaigns.draws.supplied import Streams
from ...runtime.system.prepared import PreparedSystem
from ..draw_space import DrawSpace
from ..flown import Flown
from ..noise import Noise
from ..sample_flights import SampleFlights, StudyProvenance
from ..study_units import units_of
from .margin_request import MarginRequest
from .margin_studies import MarginStudies
from .objective import SIZES, Objective, margin_objective, metric_objective
from .outcome import WorstOutcome
from .realisations import REALISATIONS, FreshNoise, Realisations, read_realisations
from .search import LEAST, SearchPhase, largest

FLIGHTS = 2000
STUDIES = 500  # a margin costs more than a simulation
MARGIN = "disk"
SIGMAS = 3.0
RANDOM = 0.2  # share of random trials, with which the worst trial is compared


class SampleEvaluator(Protocol):
    """Evaluator of samples, by simulation or by a stability study.

    ``fly`` returns the evaluations, and the drawn and derived values.
    """

    facts: StudyProvenance
    noise: Noise
    prepared: PreparedSystem
    lost: Counter[str]

    def fly(self, columns: Columns, streams: Streams) -> tuple[Sampled, Mapping[str, np.ndarray]]: ...


class Sampled(Protocol):
    """Evaluations of samples: columns (draws,) by name, and a mask (draws,) of the evaluations that exist."""

    @property
    def metrics(self) -> Mapping[str, np.ndarray]: ...
    @property
    def flown(self) -> np.ndarray: ...


class WorstCaseOptions(TypedDict, total=False):
    """Options of a search by name; ``sigmas`` bounds normal draws, the other options are as in `worst_case`."""

    sigmas: float
    hold: Mapping[str, float] | None
    noise_trial: int | None
    realisations: int | None
    quantile: float | None
    workers: int | None


def worst_case(
    plan: BatchPlan, metric: str | None = None, *, flights: int = FLIGHTS, **options: Unpack[WorstCaseOptions]
) -> WorstOutcome:
    """Search for the draws that maximise an expression, normal draws within ``sigmas`` and others in their intervals.

    ``metric`` is an expression over metrics and draws, by default the margin of success. ``hold`` and ``noise_trial``
    are as in `rare_failure`. If components have noise, every point is simulated with the same number of
    ``realisations`` of it (by default 5, or one per hundred ``flights`` if there are fewer than 500), and the
    ``quantile`` of their values (by default the median) is maximised; the worst point is simulated with ten times as
    many fresh realisations. A fifth of the ``flights`` are random trials, which serve as starting points and for
    comparison. The search uses the campaign's seed; ``workers`` does not change the result. Raises InputError.
    """
    search = _Search(plan, flights, REALISATIONS, **options)
    objective = metric_objective(plan.campaign, metric)
    with SampleFlights(plan, search.middle, noise_trial=search.noise_trial, workers=search.workers) as flights_of:
        return search.result(flights_of, objective)


def worst_margin(
    asked: MarginRequest, margin: str = MARGIN, *, flights: int = STUDIES, **options: Unpack[WorstCaseOptions]
) -> WorstOutcome:
    """Search for the draws that minimise the least margin of a loop's channels, in the box of `worst_case`.

    ``margin`` is one of `SIZES`. An unstable loop is worse than any margin, ranked by its spectral radius; draws that
    cannot be studied are worse than all others. Other arguments are as in `worst_case`, except that ``realisations`` is
    1 by default, since noise only affects a loop's margin through the state at the operating point. Raises InputError.
    """
    if margin not in SIZES:
        raise InputError("`margin`", margin, "no such margin", f"give {', '.join(SIZES)}")
    search = _Search(asked.plan, flights, 1, **options)
    with MarginStudies(asked, search.middle, noise_trial=search.noise_trial, workers=search.workers) as studies:
        objective = margin_objective(asked.loop.name, asked.point.name, studies.channels, margin)
        result = search.result(studies, objective)
        return replace(result, reason=studies.reasons[result.places[0]])


class _Search:
    """Search with its region and its budget. Raises InputError."""

    def __init__(
        self,
        plan: BatchPlan,
        flights: int,
        default_realisations: int,
        sigmas: float = SIGMAS,
        hold: Mapping[str, float] | None = None,
        noise_trial: int | None = None,
        realisations: int | None = None,
        quantile: float | None = None,
        workers: int | None = None,
    ) -> None:
        self._over = read_realisations(realisations, quantile, flights, noise_trial, default=default_realisations)
        if flights < LEAST:
            raise InputError("`flights`", str(flights), "too few", f"give {LEAST} or more")
        if not 0.0 < sigmas < 20.0:
            raise InputError(
                "`sigmas`", f"{sigmas:g}", "not a valid size of the search box", "give a number above 0, such as 3"
            )
        self._space = DrawSpace(plan.campaign, hold)
        self._sigmas, self._flights, self._seed = sigmas, flights, plan.campaign.seed
        self.noise_trial, self.workers = noise_trial, workers

    @property
    def middle(self) -> Columns:
        return self._space.from_box(np.full((1, self._space.size), 0.5), self._sigmas)

    def result(self, flights_of: SampleEvaluator, objective: Objective) -> WorstOutcome:
        """Return the worst case of random trials and of a search that starts from these. Raises InputError."""
        space, sigmas = self._space, self._sigmas
        points = _Points(flights_of, objective, self._over if flights_of.noise.sources else None)
        budget = self._flights - (
            0 if points.over is None else points.over.fresh
        )  # without the simulations with fresh noise
        random = np.random.Generator(np.random.Philox(np.random.SeedSequence(self._seed)))
        own = space.from_normals(standard_normals(random, (int(RANDOM * budget) // points.realisations, space.size)))
        places = space.to_box(own, sigmas)
        values = points.fly(places, own)
        inside = np.all((places >= 0.0) & (places <= 1.0), axis=1)
        if not inside.any():
            problem = f"none of {len(values)} random trials is within {sigmas:g} sigmas in all draws"
            raise InputError("`sigmas`", f"{sigmas:g}", problem, "give a larger number")
        left = budget - points.flights
        points.drop_ineffective_noise()
        place, value, phases = largest(
            lambda points_: points.fly(points_, space.from_box(points_, sigmas)),
            places[inside],
            values[inside],
            left // points.realisations,
            random,
        )
        worst, worst_random = points.row_of(place, value), points.row_of(places[int(np.argmax(values))], values.max())
        fresh = points.fly_fresh(worst, input_names(space.campaign)) if points.over is not None else None
        return WorstOutcome(
            badness=objective,
            sigmas=sigmas,
            value=value,
            place=place,
            row=worst,
            random=worst_random,
            random_trials=len(values),
            space=space,
            flown=points.flown.whole(),
            facts=flights_of.facts,
            lost=flights_of.lost,
            noise=flights_of.noise,
            units=units_of(space, flights_of.prepared, flights_of.facts),
            over=points.over,
            fresh=fresh,
            noise_matters=points.effect,
            phases=(SearchPhase("random trials", len(values)), *phases),
        )


class _Points:
    """Points simulated with common realisations of noise; ``over`` is None if there is no random noise.

    ``effect`` tells whether the noise changed a value of the random trials; if not, points are simulated only once.
    """

    def __init__(self, flights_of: SampleEvaluator, objective: Objective, over: Realisations | None) -> None:
        self._flights_of, self._objective = flights_of, objective
        self.over, self.flown, self.flights = over, Flown(), 0
        self.realisations = 1 if over is None else over.count
        self.effect: bool | None = None
        self._varied = False

    def fly(self, places: np.ndarray, columns: Mapping[str, np.ndarray]) -> np.ndarray:
        """Return the objective of points (points,)."""
        count = self.realisations
        columns = {name: np.repeat(column, count) for name, column in columns.items()}
        values = self._fly(np.repeat(places, count, axis=0), columns, np.tile(np.arange(count), len(places)))
        rows = values.reshape(len(places), count)
        self._varied |= bool(np.any(rows != rows[:, :1]))
        return rows[:, 0] if self.over is None or count == 1 else self.over.objective(rows)

    def drop_ineffective_noise(self) -> None:
        """Use one realisation after the random trials if noise has not changed any of their values."""
        if self.realisations > 1:
            self.effect = self._varied
            self.realisations = self.realisations if self._varied else 1

    def fly_fresh(self, row: int, names: Sequence[str]) -> FreshNoise:
        """Simulate the point of a row with realisations of noise that the search has not used."""
        assert self.over is not None
        whole, count = self.flown.whole(), self.over.fresh
        columns = {name: np.full(count, whole.draws[name][row]) for name in names}
        values = self._fly(np.tile(whole.points[row], (count, 1)), columns, self.over.count + np.arange(count))
        return FreshNoise(values, self.over.quantile)

    def row_of(self, place: np.ndarray, value: float) -> int:
        """Return the first simulation with the point's objective, since a quantile is the value of a simulation."""
        whole = self.flown.whole()
        return int(np.argmax(np.all(whole.points == place, axis=1) & (whole.values == value)))

    def _fly(self, places: np.ndarray, columns: Mapping[str, np.ndarray], streams: np.ndarray) -> np.ndarray:
        trials, draws = self._flights_of.fly(dict(columns), self._flights_of.noise.same(streams))
        values = self._objective({**draws, **trials.metrics}, trials.flown)
        self.flown.add(places, draws, trials.metrics, values)
        self.flights += len(values)
        return values
