"""Elements of two vectors connected in a different order, although other elements are connected index by index."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from ..network import Network, NodeLink

ELEMENT = re.compile(r"(.+)\[([\d, ]+)\]")
Index = tuple[int, ...]


def crosswise_notes(network: Network) -> list[str]:
    """Return a note for each connection x[2] -> y[1] if other elements of x and y are connected with equal indices.

    Connections in increasing order (x[1] -> y[1], x[3] -> y[2]), and of one element to all elements of y, are
    considered intended.
    """
    by_vectors: dict[tuple[str, str], list[tuple[Index, Index, NodeLink]]] = {}
    for link in network.driver.values():
        source, target = (ELEMENT.fullmatch(node.name) for node in (link.source, link.target))
        if source and target:
            pairs = by_vectors.setdefault((source[1], target[1]), [])
            pairs.append((_index(target[2]), _index(source[2]), link))
    return [f"{network.file}: {note}" for pairs in by_vectors.values() for note in _notes(sorted(pairs, key=_key))]


def _notes(pairs: list[tuple[Index, Index, NodeLink]]) -> Iterator[str]:
    straight = next((link for target, source, link in pairs if target == source), None)
    sources = [source for _, source, _ in pairs]
    is_in_order = all(one < other for one, other in pairwise(sources)) or len(set(sources)) == 1
    for target, source, link in () if straight is None or is_in_order else pairs:
        if target != source:
            others = f"{straight.source.name} -> {straight.target.name}" if straight else ""
            yield f"{link.where}: connects elements of different indices, while {others} connects equal indices"


def _index(text: str) -> Index:
    return tuple(int(part) for part in text.split(","))


def _key(pair: tuple[Index, Index, NodeLink]) -> Index:
    return pair[0]
