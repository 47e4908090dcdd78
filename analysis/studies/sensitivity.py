"""Sensitivity of a campaign's metrics to its draws: Sobol' indices from dedicated simulations, and the result."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TypedDict

import numpy as np

from ...common.errors import InputError
from ..campaigns.definition.plan import BatchPlan
from ..runtime.loop.elementary import elementary
from .draw_space import DrawSpace
from .flown import Flown, StudyResult, strict_number
from .sample_flights import SampleFlights
from .sobol import CONFIDENCE, Indices, indices, rank_correlations, saltelli_points, with_noise
from .study_units import units_of

SUCCESS = "success"
NOISE = "noise realisation"  # name of the input that represents all random noise
EDGE = 2.0**-40  # distance from the ends of the unit interval, where normal draws are infinite


def sensitivity(
    plan: BatchPlan,
    base: int,
    *,
    hold: Mapping[str, float] | None = None,
    noise_trial: int | None = None,
    workers: int | None = None,
    tell: Callable[[str], object] = lambda price: None,
) -> SensitivityOutcome:
    """Compute first-order and total Sobol' indices of every metric and of success.

    This takes ``base`` * (draws + 3) simulations, since the noise of all components is one input in addition to the
    draws, or ``base`` * (draws + 2) if ``noise_trial`` fixes it for all simulations, or no component has noise.
    ``base`` is a power of two, at least 32. Jointly normal draws are rejected, as their shares cannot be separated:
    hold them. ``hold`` and ``noise_trial`` are as in `rare_failure`. ``tell`` receives the cost before any simulation.
    The points are drawn with the campaign's seed; ``workers`` does not change the result. Raises InputError.
    """
    if base < 32 or base & (base - 1):
        raise InputError("`base`", str(base), "not 32, 64, 128 or a higher power of two", "give 64, 128, 256, ...")
    space = DrawSpace(plan.campaign, hold)
    if not space.independent:
        draw = next(draw for draw in plan.campaign.draws if len(draw.names) > 1 and draw.names[0] in space.names)
        problem = "jointly normal values have no separate indices"
        held = " ".join(f"`hold` {name}=VALUE" for name in draw.names)
        raise InputError(plan.campaign.file, f"draw.{draw.name}", problem, f"hold these values: {held}")
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
        return SensitivityOutcome(
            base=base,
            space=space,
            with_indices=tuple(reported),
            indices=computed,
            without_indices=_reasons(metrics, reported),
            ranks=ranks,
            flown=flown.whole(),
            facts=flights.facts,
            lost=flights.lost,
            noise=noise,
            units=units_of(space, flights.prepared, flights.facts),
        )


def _reasons(metrics: Mapping[str, np.ndarray], with_indices: list[str]) -> dict[str, str]:
    """Return the reason for each number without indices."""
    reasons = {}
    for name, values in metrics.items():
        if name not in with_indices:
            lacking = int(np.sum(~np.isfinite(values)))
            reasons[name] = f"not finite in {lacking} simulations" if lacking else f"{values[0]:g} in all simulations"
    return reasons


class InputIndices(TypedDict, total=False):
    """Indices of an input with their intervals, and its rank correlation (None for noise, which has no order)."""

    rank: float | None
    first: float
    first_interval: list[float | None]
    total: float
    total_interval: list[float | None]


@dataclass(frozen=True, eq=False, kw_only=True)
class SensitivityOutcome(StudyResult):
    """Sobol' ``indices`` of metrics and success, in the order of ``with_indices``; None if no number has indices.

    ``without_indices`` has the reason for each number without indices. ``ranks`` contains rank correlations by number
    and draw; noise has no rank correlation.
    """

    DRAWS = "draws.parquet"

    base: int
    with_indices: tuple[str, ...]
    indices: Indices | None
    without_indices: Mapping[str, str]
    ranks: Mapping[str, Mapping[str, float | None]]

    @property
    def inputs(self) -> list[str]:
        """Varied inputs: the draws and, if random, the noise as one input."""
        return [*self.space.names, *([NOISE] if self.noise.sources else [])]

    def of(self, number: str) -> dict[str, InputIndices]:
        """Return the effect of each input on a metric or on ``success``."""
        rows: dict[str, InputIndices] = {name: {"rank": self.ranks[number].get(name)} for name in self.inputs}
        if self.indices is not None and number in self.with_indices:
            row = self.with_indices.index(number)
            for index, name in enumerate(self.inputs):
                rows[name] |= {
                    "first": float(self.indices.first[row, index]),
                    "first_interval": [strict_number(end) for end in self.indices.first_interval[:, row, index]],
                    "total": float(self.indices.total[row, index]),
                    "total_interval": [strict_number(end) for end in self.indices.total_interval[:, row, index]],
                }
        return rows

    def json_document(self, folder: Path | None = None) -> dict[str, object]:
        """Return the result as JSON; ``folder`` is the folder to which it has been written, or None."""
        replay = self.replay(folder, 0)
        return {
            **self.facts,
            **self._condition_document(),
            "inputs": self.inputs,
            "units": dict(self.units),
            "base": self.base,
            "flights": self.flights,
            "confidence": CONFIDENCE,
            "sensitivity": {name: self.of(name) for name in self.ranks},
            "without_indices": dict(self.without_indices),
            **({"replay": replay} if replay else {}),
        }

    def write(self, folder: Path) -> None:
        """Write sensitivity.json, flights.parquet, and draws.parquet of all simulations for `--draws`."""
        self._write(folder, "sensitivity", "success", np.arange(self.flights))
