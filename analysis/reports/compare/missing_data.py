"""What the results that are compared lack for a full page, and what the campaign must record for it."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from ...campaigns.compare.comparison import Comparison
from .consistency import is_over_sigma
from .dispersions import UNITS
from .metrics import MASS
from .recorded import CONSISTENCY, DIRECTIONS, KNOWN, Flight, variable_of

PATH = frozenset(KNOWN) - {*DIRECTIONS, *CONSISTENCY}  # what tells that something is under way


def missing_parts(
    comparison: Comparison,
    flights: Mapping[str, list[Flight]],
    *,
    trajectories: bool,
    kinds: Collection[str],
    ends: Collection[str],
) -> dict[str, str]:
    """By section, what the results lack and what the campaign must record for it.

    ``kinds`` are those of the quantities over time that there are, ``ends`` what final values there are of. Of what
    goes nowhere, such as an attitude, no trajectory, thrust, end or propellant is missed.
    """
    reasons = {}
    goes = _goes_somewhere(comparison)
    if not any(flights.values()):
        remedy = "give the campaign's [record] the keys every, signals and trials"
        reasons["trajectories"] = f"No trajectories and no commands over time: no flight has a trace; {remedy}."
    else:
        if goes and not trajectories:
            reasons["trajectories"] = "No trajectories: no position[1], [2] and [3] in m is among the recorded signals."
        if goes and "commands" not in kinds:
            words = "thrust_acceleration, thrust or thrust_direction"
            reasons["commands"] = f"No commands: no {words} is among the recorded signals."
        without = [label for label, retained in flights.items() if not retained]
        if without:
            reasons["traces"] = f"No flight has a trace: {', '.join(without)}."
    lacking = [variable for variable in UNITS if variable not in ends]
    if goes and lacking:
        words = " and ".join(lacking)
        reasons["ends"] = f"No dispersion of the final {words}: [record] final does not keep its three elements."
    if goes and not _has_mass(comparison):
        reasons["propellant"] = "No propellant: no metric is in kg, and [record] final does not keep a mass."
    if "consistency" not in kinds and not any(is_over_sigma(metric) for metric in comparison.metrics):
        reasons["consistency"] = "No normalised estimation errors: no metric's name ends in _over_sigma."
    return reasons


def _goes_somewhere(comparison: Comparison) -> bool:
    """Whether a signal of something under way is kept, or none of any kind, which leaves it open."""
    retained = {variable_of(batch, name) for batch in comparison.batches.values() for name in batch.document["signals"]}
    return not retained or bool(retained & PATH)


def _has_mass(comparison: Comparison) -> bool:
    return any(metric.unit == MASS for metric in comparison.metrics) or any(
        variable_of(contender.stored, name) == "mass"
        for contender in comparison.contenders.values()
        for name in contender.trials.final
    )


def is_biased(comparison: Comparison, flights: Mapping[str, list[Flight]]) -> bool:
    """Whether what is shown over time is not the same trials of every contender, or failed ones only."""
    trials = {tuple(flight.trial for flight in retained) for retained in flights.values() if retained}
    records = [batch.document["record"] for batch in comparison.batches.values()]
    return len(trials) > 1 or any(record["every"] is None and record["traces"] == "failures" for record in records)
