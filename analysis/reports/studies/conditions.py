"""What the numbers of a study are conditional on: system, campaign, dispersed parameters, held values, noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Any

from ...campaign.draw_space import DrawSpace
from ..batch.batch_report import draw_rows, fmu_rows

DEFAULT = "default"  # the name of a campaign's only variant


@dataclass(frozen=True)
class Conditions:
    """What stands in the headline of every study, since its numbers hold under these conditions only.

    ``given`` qualifies a number in a sentence: empty where the noise is random or absent. ``noise`` says which of the
    two it is, or whose noise all simulations have. ``draws`` are rows (name, distribution, arguments), ``fmus`` rows
    (component, variants, SHA-256).
    """

    system: str
    campaign: str
    variant: str
    parameters: list[str]
    held: Mapping[str, float]
    faults: list[str]
    noise: str
    given: str
    draws: list[tuple[str, str, str]]
    fmus: list[tuple[str, str, str]]
    facts: Mapping[str, Any]


def conditions_of(space: DrawSpace, facts: Mapping[str, Any], noise: str, given: str) -> Conditions:
    """The conditions of a study over ``space``, whose result has ``facts``."""
    (variant,) = facts["fmus"]
    return Conditions(
        system=facts["system"],
        campaign=campaign_name(facts["campaign"]),
        variant="" if variant == DEFAULT else variant,
        parameters=space.names,
        held=space.held,
        faults=list(facts.get("faults", [])),
        noise=noise or "No component draws random numbers of its own.",
        given=given,
        draws=draw_rows(space.campaign),
        fmus=fmu_rows(facts["fmus"]),
        facts=facts,
    )


def campaign_name(label: str) -> str:
    """A campaign's name as commands take it: of a system's own campaign its stem, else the file."""
    inside = label.partition("!")[2]
    return PurePosixPath(inside).stem if inside else label
