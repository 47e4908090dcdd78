"""Margins at chosen draws of a campaign, computed by persistent processes that each keep the loop ready."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from loky import ProcessPoolExecutor

from ....common.errors import InputError
from ....common.family.pools import process_pool
from ....common.progress import progress_bar
from ...campaigns.definition.checks import check_draws
from ...campaigns.definition.plan import BatchPlan
from ...campaigns.draws.interfaces import Columns
from ...campaigns.draws.supplied import Streams
from ...campaigns.execute.workers import worker_count
from ...stability.dispersion import models_of_trial
from ...stability.loops.margin_values import LoopMargins
from ...stability.point.bench import StudyError
from ...stability.point.point_study import PointStudy
from ..noise import make_samples, noise_of
from ..sample_flights import plan_of_samples, study_provenance
from .margin_request import MarginRequest
from .objective import margin_columns


class MarginSamples(NamedTuple):
    """Margins of samples, in the form of metrics: columns by name, and a mask of the rows that exist."""

    metrics: dict[str, np.ndarray]
    flown: np.ndarray


class MarginStudies:
    """Evaluator of a loop's margins at chosen draws. A context manager, since it holds processes.

    ``first`` are draws with which the request is checked; other arguments are as in `SampleFlights`, which this class
    replaces. ``reasons`` contains for every study the reason why it found no margin, "" if it did. The relevant memory
    cells are determined once, at the nominal point. Raises InputError, also if the nominal point cannot be studied.
    """

    def __init__(
        self, asked: MarginRequest, first: Columns, *, noise_trial: int | None = None, workers: int | None = None
    ) -> None:
        self._count = worker_count(workers)
        self._plan = plan_of_samples(replace(asked.plan, campaign=replace(asked.plan.campaign, faults=())), first)
        self._asked = replace(asked, request=replace(asked.request, plan=self._plan))
        self._study, self._cells = _nominal(self._asked)
        prepared = self.prepared = self._study.prepared
        self.noise = noise_of(prepared, noise_trial, self._plan.campaign.seed)
        check_draws(self._plan, [prepared])
        self.channels = [channel.name for channel in self._study.channels]
        self.reasons: list[str] = []
        self.lost: Counter[str] = Counter()  # never counted: a study whose simulation is lost has a reason
        self.facts = study_provenance(self._plan, {"default": prepared})
        self.facts |= {"loop": asked.loop.name, "point": asked.point.name, "time": self._study.bench.time}
        self._held = ExitStack()
        self._held.callback(self._study.close)
        self._pool: ProcessPoolExecutor | None = None
        if self._count > 1:
            pool = process_pool(self._count, _begin, self._asked, self._cells)
            self._pool = self._held.enter_context(pool)
        self._progress = progress_bar(unit="study")

    def fly(self, columns: Columns, streams: Streams) -> tuple[MarginSamples, Mapping[str, np.ndarray]]:
        """Return the margins of samples with these random streams, in order, and the drawn and derived values.

        ``streams`` are those of all sources of noise, by component. Raises InputError.
        """
        plan = self._plan.of_samples(make_samples(columns, streams, self.noise))
        check_draws(plan, [self._study.prepared])
        rows: list[list[LoopMargins] | None] = []
        plans = [plan.of_part(range(trial, trial + 1)) for trial in range(plan.campaign.trials)]
        for margins in self._read_result(plans):
            self.reasons.append(margins if isinstance(margins, str) else "")
            rows.append(None if isinstance(margins, str) else margins)
            self._progress.update()
        studied = MarginSamples(margin_columns(self.channels, rows), np.array([row is not None for row in rows]))
        return studied, plan.draws.of_part(range(plan.campaign.trials)).columns

    def _read_result(self, plans: Sequence[BatchPlan]) -> Iterable[list[LoopMargins] | str]:
        if self._pool is None:
            return (_margins(self._study, self._cells, plan) for plan in plans)
        return self._pool.map(_in_process, plans)

    def __enter__(self) -> MarginStudies:
        return self

    def __exit__(self, *problem: Any) -> None:
        self._progress.close()
        self._held.__exit__(*problem)


def _nominal(asked: MarginRequest) -> tuple[PointStudy, list[int]]:
    """Return the study of the point without draws, and its relevant memory cells. Raises InputError."""
    where = (asked.request.label, f"loop {asked.loop.name} at {asked.point.name}")
    remedy = "search a margin that perilune stability can study"
    try:
        study = asked.open_request()
    except StudyError as error:
        raise InputError(*where, str(error), remedy) from error
    study.linearise()
    if study.linear is None:
        study.close()
        raise InputError(*where, study.why_not, remedy)
    return study, study.linear.cells


def _margins(study: PointStudy, cells: Sequence[int], plan: BatchPlan) -> list[LoopMargins] | str:
    """Return the margins of every channel in the one trial of a plan, or the reason for their absence."""
    try:
        return [model.margins() for model in models_of_trial(study, plan, 0, cells).values()]
    except (InputError, StudyError) as error:
        return str(error)


_begun: tuple[PointStudy, Sequence[int]] | None = None  # state of a worker process


def _begin(asked: MarginRequest, cells: Sequence[int]) -> None:
    global _begun
    _begun = asked.open_request(), cells


def _in_process(plan: BatchPlan) -> list[LoopMargins] | str:
    assert _begun is not None  # the process was started with it
    return _margins(*_begun, plan)
