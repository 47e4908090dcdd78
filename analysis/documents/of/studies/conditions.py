"""Statements common to all studies: conditions of their numbers, dispersed parameters, replays, provenance."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePosixPath

from ....studies.flown import StudyResult
from ....studies.noise import Noise
from ...cell import Cell, Code, Quantity, Rich
from ...model import Commands, KeyNumbers, Medium, Node, Note, Only, Section, Table, Text
from ..campaign.campaign_origin import fmu_rows, parameter_table

DEFAULT = "default"  # the name of a campaign's only variant
UNWRITTEN: Rich = [
    "the samples were not written: with ", Code("--output DIR"), " (in Python ", Code("output="),
    ") they are written, and the command that replays them is shown here",
]  # fmt: skip


def condition_of(study: StudyResult) -> str:
    """Return the condition of all numbers of a study; empty if they are unconditional."""
    return study.conditions.removeprefix(", ")


def condition_nodes(study: StudyResult, noise: str = "random") -> list[Node]:
    """Return statements on system, campaign, dispersed parameters, noise, faults and assumptions.

    ``noise`` describes how the random noise of components is simulated.
    """
    provenance = study.facts
    (variant,) = provenance["fmus"]
    fmus = "" if variant == DEFAULT else f" with {variant}"
    system = f"system {provenance['system']}{fmus}, campaign {campaign_name(provenance['campaign'])}"
    faults = provenance.get("faults", [])
    return [
        Text(f"{system}; {_dispersed(study.space.names)}"),
        Text(_noise(study.noise, noise)),
        *([Text(["faults: ", Code("; ".join(faults))])] if faults else []),
        *(Text(f"assumed: {assumption}") for assumption in provenance.get("assumptions", ())),
        *([Text(f"all numbers: {condition_of(study)}")] if study.conditions else []),
    ]


def campaign_name(label: str) -> str:
    """Return a campaign's name as commands accept it: the stem of a system's own campaign, else the file."""
    inside = label.partition("!")[2]
    return PurePosixPath(inside).stem if inside else label


def _dispersed(names: Sequence[str]) -> str:
    if not names:
        return "no parameter is dispersed"
    return f"{len(names)} dispersed parameter{'s' if len(names) > 1 else ''}: {', '.join(names)}"


def _noise(noise: Noise, random: str) -> str:
    if not noise.components:
        return "no component draws random numbers"
    names = ", ".join(noise.components)
    if noise.is_held:
        return f"noise of {names}: noise of trial {noise.trial} in all simulations, seed {noise.seed}"
    return f"noise of {names}: {random}"


def closing_sections(
    study: StudyResult, replays: Sequence[tuple[str, str]], missing: Rich = UNWRITTEN
) -> list[Section]:
    """Return the sections of replays, dispersed parameters and provenance; ``missing`` explains missing replays."""
    return [
        Section("Replay", [Commands(replays, missing)]),
        Section("Dispersed parameters", [Only(Medium.PAGE, lambda: _draws(study))]),
        Section("Provenance", [Only(Medium.PAGE, lambda: _provenance(study))]),
    ]


def _draws(study: StudyResult) -> list[Node]:
    units = "As the campaign declares them, in SI units. Metrics and draws have the units of the campaign."
    return [parameter_table(study.space.campaign), Note(units)]


def _provenance(study: StudyResult) -> list[Node]:
    provenance = study.facts
    numbers: list[tuple[str, Cell]] = [
        ("seed", provenance["seed"]),
        ("step", Quantity(provenance["step"], "s")),
        ("algorithm", provenance["algorithm"]),
    ]
    if provenance["parameter_sets"]:
        numbers.append(("parameter sets", ", ".join(provenance["parameter_sets"])))
    settings = [f"{name} = {value}" for name, value in provenance["set"].items()]
    hashes = [("system", provenance["system_sha256"])]
    hashes += [(component, digest) for component, _, digest in fmu_rows(provenance["fmus"])]
    return [
        KeyNumbers([*numbers, ("perilune", provenance["perilune"])]),
        *([Note(["Set: ", Code(", ".join(settings)), "."])] if settings else []),
        Note(["Campaign ", Code(provenance["campaign"])]),
        Table(("part", "SHA-256"), [(part, Code(digest, is_long=True)) for part, digest in hashes]),
    ]
