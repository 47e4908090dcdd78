"""Statements on the origin of a campaign's numbers: faults, assumptions, dispersed parameters, digests of files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ....campaigns.definition.campaign import Campaign
from ....reports.campaign.tables import draw_rows
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
    """Return the dispersed parameters as the campaign declares them."""
    rows = [
        (name, distribution, Code(arguments, is_long=True)) for name, distribution, arguments in draw_rows(campaign)
    ]
    return Table(("name", "distribution", "arguments"), rows)


def digest_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """Return parts with the digests of their files, the last cell of each row."""
    return Table((*heads, "SHA-256"), [(*row[:-1], Digest(row[-1])) for row in rows], style="")
