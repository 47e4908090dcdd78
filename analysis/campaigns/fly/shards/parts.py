"""The pieces in which shards are flown, put together again."""

from __future__ import annotations

from collections.abc import Sequence

from ...trials import Trials, join_trials
from .numbering import Numbering


class Parts:
    """Takes pieces of shards in any order, and gives a shard back as soon as all of its trials are there."""

    def __init__(self, numbering: Numbering, variants: Sequence[str]) -> None:
        self._numbering = numbering
        self._variants = variants
        self._pieces: dict[int, dict[str, list[Trials]]] = {}

    def add(self, shard: int, variant: str, trials: Trials) -> dict[str, Trials] | None:
        """The trials of the shard by variant, if this was the last piece of it."""
        pieces = self._pieces.setdefault(shard, {name: [] for name in self._variants})
        pieces[variant].append(trials)
        flown = sum(len(piece.trial) for parts in pieces.values() for piece in parts)
        if flown < len(self._numbering.of(shard)) * len(self._variants):
            return None
        return {name: join_trials(parts) for name, parts in self._pieces.pop(shard).items()}
