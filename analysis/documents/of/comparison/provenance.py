"""Sections on the origin of a comparison's numbers: dispersed parameters, and files of each batch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ....campaigns.compare.campaign_comparison import CampaignComparison
from ...cell import Cell, Code, Inline, Quantity
from ...model import Group, Missing, Node, Note, Section, Table
from ..campaign.campaign_origin import fmu_rows
from ..origin import digest_table
from .header import parameter_sets

DIGITS = 6


def parameter_section(comparison: CampaignComparison) -> Section:
    """Return the section with the range of each dispersed parameter over the trials."""
    rows: list[Sequence[Cell]] = [
        (name, *(Quantity(float(each), digits=DIGITS) for each in (values.min(), values.mean(), values.max())))
        for name, values in comparison.first.draws.items()
    ]
    nodes: list[Node] = [Missing("nothing: trials differ by the components' random streams only")]
    if rows:
        trials = comparison.first.document["trials"]
        note = Note(f"In the campaign's own units, over its {trials} trials.")
        nodes = [Table(("name", "least", "mean", "largest"), rows, style=""), note]
    return Section("Dispersed parameters", nodes, is_folded=True)


def provenance_section(comparison: CampaignComparison) -> Section:
    """Return the section with campaign, parameters and digests of each batch."""
    groups = [Group(name, _batch_nodes(batch.document)) for name, batch in comparison.batches.items()]
    return Section("Provenance", groups, is_folded=True)


def _batch_nodes(document: Mapping[str, Any]) -> list[Node]:
    settings: list[Inline] = [
        "Campaign ", Code(document["campaign"]),
        f", {document['trials']} trials, seed {document['seed']}, step ", Quantity(document["step"], "s"),
        f", {document['algorithm']}, perilune {document['perilune']}. Parameter sets: ",
        parameter_sets(document["parameter_sets"]), ".",
    ]  # fmt: skip
    if document["set"]:
        values = ", ".join(f"{name} = {value}" for name, value in document["set"].items())
        settings += [" Set: ", Code(values), "."]
    if document["variant"]:
        settings.append(f" Variant of the system: {document['variant']}.")
    rows = [
        ("system", "all", document["system_sha256"]),
        ("campaign", "all", document["campaign_sha256"]),
        *fmu_rows(document["fmus"]),
    ]
    return [Note(settings), digest_table(("part", "variants"), rows)]
