"""Statements on the origin of numbers: faults, assumptions, digests of files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..cell import Code, Digest
from ..model import Node, Note, Table


def condition_notes(provenance: Mapping[str, Any]) -> list[Node]:
    """Return the injected faults and the assumptions about the simulated system."""
    faults = provenance.get("faults", [])
    return [
        *([Note(["Faults: ", Code("; ".join(faults)), "."])] if faults else []),
        *(Note(f"Assumed: {assumption}.") for assumption in provenance.get("assumptions", ())),
    ]


def digest_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """Return a table of items with the digests of their files, the last cell of each row."""
    return Table((*heads, "SHA-256"), [(*row[:-1], Digest(row[-1])) for row in rows], style="")
