"""Subset simulation as a terminal shows it: the estimate, what it took, the levels."""

from __future__ import annotations

from .subset_simulation import Level, SubsetSimulation
from .uncertainty import CONFIDENCE

LEVEL_HEADS = [
    "level", "threshold", "samples", "probability", "accepted: draws", "noise", "lowest source", "gamma", "c.o.v.",
]  # fmt: skip


def estimate_text(simulation: SubsetSimulation) -> str:
    """What is known of the probability."""
    interval, percent = simulation.interval, f"{100 * CONFIDENCE:g} %"
    if simulation.probability is None:
        return f"not reached; probability below {interval.high:.3g}, {percent}"
    return f"probability {simulation.probability:.3g}, {percent} interval {interval.low:.3g} to {interval.high:.3g}"


def cost_text(simulation: SubsetSimulation, conditions: str) -> str:
    """How many flights it took, and how many plain Monte Carlo takes for as much under the same ``conditions``."""
    levels = len(simulation.levels)
    text = f"{simulation.evaluations} flights in {levels} level{'s' if levels > 1 else ''}"
    trials = simulation.equivalent_trials
    return text if trials is None else f"{text}; equivalent Monte Carlo sample size: {trials:.2g}{conditions}"


def level_rows(simulation: SubsetSimulation) -> list[list[str]]:
    """The table of levels, its heading first."""
    return [LEVEL_HEADS, *(_level_cells(number, level) for number, level in enumerate(simulation.levels, 1))]


def _level_cells(number: int, level: Level) -> list[str]:
    return [
        str(number),
        _cell(level.threshold, ".4g"),
        str(level.samples),
        _cell(level.probability, ".4f"),
        _cell(level.draw_acceptance, ".2f"),
        _cell(level.noise_acceptance, ".3f"),
        _cell(level.least_acceptance, ".3f"),
        f"{level.correlation:.2f}",
        _cell(level.deviation, ".3f"),
    ]


def _cell(value: float | None, form: str) -> str:
    return "-" if value is None else format(value, form)
