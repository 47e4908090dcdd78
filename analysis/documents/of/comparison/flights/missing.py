"""Statements on data that the record of a comparison lacks, and on bias in its simulations over time."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from .....campaigns.compare.campaign_comparison import CampaignComparison
from ...campaign.recorded_names import CONSISTENCY, DIRECTIONS, KNOWN, variable_of
from ..sigma import is_over_sigma
from ..variant_distributions import MASS
from .ends import UNITS
from .recorded import ComparedFlight

PATH = frozenset(KNOWN) - {*DIRECTIONS, *CONSISTENCY}  # variables of a moving body


def missing_statements(
    comparison: CampaignComparison,
    flights: Mapping[str, list[ComparedFlight]],
    *,
    trajectories: bool,
    kinds: Collection[str],
    ends: Collection[str],
) -> dict[str, str]:
    """Return, by section, the data that the results lack, and the record that a campaign needs to provide them.

    ``kinds`` are the kinds of available quantities over time, and ``ends`` are the variables with final values. A
    system without a path, such as one of attitude alone, lacks nothing: it has no trajectory, thrust, final error or
    propellant.
    """
    reasons = {}
    retained = {
        variable_of(batch.document, name) for batch in comparison.batches.values() for name in batch.document["signals"]
    }
    moves = not retained or bool(retained & PATH)  # without recorded signals it is unknown whether a body moves
    has_mass = any(metric.unit == MASS for metric in comparison.metrics) or any(
        variable_of(contender.stored.document, name) == "mass"
        for contender in comparison.contenders.values()
        for name in contender.trials.final
    )
    if not any(flights.values()):
        remedy = "give the campaign's [record] the keys every, signals and trials"
        reasons["trajectories"] = f"No trajectories and no commands over time: no flight has a trace; {remedy}"
    else:
        if moves and not trajectories:
            reasons["trajectories"] = (
                "No trajectories: the recorded signals do not contain position[1], [2] and [3] in m"
            )
        if moves and "commands" not in kinds:
            words = "thrust_acceleration, thrust or thrust_direction"
            reasons["commands"] = f"No commands: the recorded signals contain no {words}"
        without = [label for label, traced in flights.items() if not traced]
        if without:
            reasons["traces"] = f"No flight has a trace: {', '.join(without)}"
    lacking = [variable for variable in UNITS if variable not in ends]
    if moves and lacking:
        words = " and ".join(lacking)
        reasons["ends"] = f"No dispersion of the final {words}: [record] final does not contain its three elements"
    if moves and not has_mass:
        reasons["propellant"] = "No propellant: no metric is in kg, and [record] final does not contain a mass"
    if "consistency" not in kinds and not any(is_over_sigma(metric) for metric in comparison.metrics):
        reasons["consistency"] = "No normalised estimation errors: no metric's name ends in _over_sigma"
    return reasons


def is_biased(comparison: CampaignComparison, flights: Mapping[str, list[ComparedFlight]]) -> bool:
    """Return True if the simulations over time show different trials for each variant, or only failed trials."""
    trials = {tuple(flight.trial for flight in retained) for retained in flights.values() if retained}
    records = [batch.document["record"] for batch in comparison.batches.values()]
    return len(trials) > 1 or any(record["every"] is None and record["traces"] == "failures" for record in records)
