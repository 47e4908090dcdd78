"""What the numbers of a study are conditional on: system, campaign, dispersed parameters, held values, noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from ...studies.noise import Noise
from ...studies.rare.outcome import RareResult
from ...studies.sensitivity import SensitivityResult
from ...studies.worst.outcome import WorstResult
from ..campaign.tables import draw_rows, fmu_rows
from ..common.page import write_page

DEFAULT = "default"  # the name of a campaign's only variant
StudyResult = RareResult | WorstResult | SensitivityResult


@dataclass(frozen=True)
class Conditions:
    """What stands in the headline of every study, since its numbers hold under these conditions only.

    ``given`` qualifies a number at the end of its line: empty where it is conditional on neither held values nor the
    noise of one trial. ``draws`` are rows (name, distribution, arguments), ``fmus`` rows (component, variants,
    SHA-256).
    """

    system: str
    campaign: str
    variant: str
    parameters: list[str]
    faults: list[str]
    noise: str
    given: str
    draws: list[tuple[str, str, str]]
    fmus: list[tuple[str, str, str]]
    facts: Mapping[str, Any]


def conditions_of(result: StudyResult) -> Conditions:
    """The conditions of a study's result."""
    facts = result.facts
    (variant,) = facts["fmus"]
    return Conditions(
        system=facts["system"],
        campaign=campaign_name(facts["campaign"]),
        variant="" if variant == DEFAULT else variant,
        parameters=result.space.names,
        faults=list(facts.get("faults", [])),
        noise=noise_words(result.noise),
        given=result.conditions,
        draws=draw_rows(result.space.campaign),
        fmus=fmu_rows(facts["fmus"]),
        facts=facts,
    )


def noise_words(noise: Noise) -> str:
    """Whether the noise is random, absent, or that of one trial, as a sentence."""
    if not noise.components:
        return "No component draws random numbers of its own."
    names = ", ".join(noise.components)
    if noise.is_held:
        return f"Noise of {names}: that of trial {noise.trial} in all simulations, not random."
    return f"Noise of {names}: random."


def campaign_name(label: str) -> str:
    """A campaign's name as commands take it: of a system's own campaign its stem, else the file."""
    inside = label.partition("!")[2]
    return PurePosixPath(inside).stem if inside else label


def write_study_page(path: Path, template: str, subject: str, result: StudyResult, **content: object) -> None:
    """Write one self-contained HTML page with the conditions of a study; the same result gives the same bytes."""
    conditions = conditions_of(result)
    title = f"{conditions.system}: {subject}"
    write_page(path, Path(__file__).with_name(template), title=title, result=result, conditions=conditions, **content)
