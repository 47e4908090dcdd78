"""Statements on the origin of a campaign's numbers: faults, assumptions, dispersed parameters, digests of files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ....campaigns.definition.campaign import Campaign
from ...cell import Code, Digest
from ...model import Node, Note, Table


def condition_notes(provenance: Mapping[str, Any]) -> list[Node]:
    """Return the faults and assumptions of simulations."""
    faults = provenance.get("faults", [])
    return [
        *([Note(["Faults: ", Code("; ".join(faults)), "."])] if faults else []),
        *(Note(f"Assumed: {assumption}.") for assumption in provenance.get("assumptions", ())),
    ]


def parameter_table(campaign: Campaign) -> Table:
    """Return dispersed parameters as the campaign declares them, then derived ones, and tables of lookups."""
    rows = []
    for draw in campaign.draws:
        distribution = draw.distribution
        rows.append((", ".join(draw.names), distribution.keyword.replace("_", " "), distribution.describe()))
    rows += [(name, "derived", " ".join(formula.text.split())) for name, formula in campaign.derived.items()]
    rows += [(each.name, "lookup", f"{each.column} of {each.file}") for each in campaign.lookups]
    body = [(name, distribution, Code(arguments, is_long=True)) for name, distribution, arguments in rows]
    return Table(("name", "distribution", "arguments"), body)


def digest_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """Return parts with the digests of their files, the last cell of each row."""
    return Table((*heads, "SHA-256"), [(*row[:-1], Digest(row[-1])) for row in rows], style="")


def fmu_rows(fmus: dict[str, dict[str, str]]) -> list[tuple[str, str, str]]:
    """Return component, variants and SHA-256 of every FMU, variants with the same FMU in one row."""
    variants_of: dict[tuple[str, str], list[str]] = {}
    for variant, components in fmus.items():
        for component, digest in components.items():
            variants_of.setdefault((component, digest), []).append(variant)
    return [
        (component, "all" if len(variants) == len(fmus) else ", ".join(variants), digest)
        for (component, digest), variants in sorted(variants_of.items(), key=lambda item: item[0][0])
    ]
