"""Documents of operations on campaign folders: prepared, shards simulated, served to a browser."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ..cell import CommandLine
from ..model import Document, Text


def prepared_document(folder: Path, shards: int, shard_size: int) -> Document:
    """Return the document of a folder with ``shards`` of ``shard_size`` trials: the commands to run next."""
    last = shards - 1
    simulate, merge = CommandLine(f"perilune shard {folder} 0-{last}"), CommandLine(f"perilune merge {folder}")
    nodes = [
        Text(f"written: {folder}, shards 0-{last}, {shard_size} trials each, the rest in the last"),
        Text(["simulate them: ", simulate, ", in any grouping; then: ", merge]),
    ]
    return Document("Prepared campaign", nodes, [], {"folder": str(folder), "shards": shards, "shard_size": shard_size})


def shards_document(simulated: int, complete_before: int, missing: int, count: int) -> Document:
    """Return the document of simulated shards, out of ``count``."""
    text = f"shards: {simulated} simulated, {complete_before} already complete, {missing} of {count} missing"
    json = {"simulated": simulated, "complete_before": complete_before, "missing": missing, "count": count}
    return Document("Shards", [Text(text)], [], json)


def served_document(folders: Iterable[Path]) -> Document:
    """Return the document shown after campaigns have been served."""
    return Document("Served campaigns", [Text("stopped")], [], {"folders": list(map(str, folders))})
