"""Document of checked files: notes on each file, and the valid files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..model import Document, Node, Text


def validation_document(checks: Sequence[Mapping[str, Any]]) -> Document:
    """Return the document of checks, each with ``path``, ``problems`` and ``notes``."""
    nodes: list[Node] = []
    for check in checks:
        nodes += [Text(f"{check['path']}: note: {note}", is_wrapped=True) for note in check["notes"]]
        nodes += [] if check["problems"] else [Text(f"{check['path']}: OK")]
    return Document("Checked files", nodes, [], checks)
