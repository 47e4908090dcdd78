"""The value of a connection's target from its sources."""

from __future__ import annotations

from collections.abc import Callable

from ..ssp.conversions import IDENTITY
from ..system.network import Link, Network, Node
from ..system.passing.parameters import numbers
from .component import FailedError, Value


def carry(network: Network, link: Link, value_of: Callable[[Node], Value]) -> Value:
    """Return what a connection, with those that are added to it, brings its target. Raises FailedError.

    ``value_of`` gives the values of sources.
    """
    total = transform(network, link, value_of(link.source))
    for term in link.added:
        change = term.transformation
        total = float(total) + (float(value_of(term.source)) * change.factor + change.offset)
    return total


def transform(network: Network, link: Link, value: Value) -> Value:
    """Return a value behind a connection's unit conversion and transformation. Raises FailedError."""
    change = link.transformation
    if change == IDENTITY:
        return value  # as it is: texts, and whole numbers that no float64 is
    if not change.table:
        return float(value) * change.factor + change.offset
    for source, target in numbers(network, link):
        if source == value:
            return target
    if change.is_partial:
        return value
    raise FailedError(f"{link.where}: its mapping has no entry for {value!r}")
