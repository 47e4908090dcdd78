"""Value at the target of a connection, computed from its sources."""

from __future__ import annotations

from collections.abc import Callable

from ..ssp.conversions import IDENTITY
from ..system.network import Network, Node, NodeLink
from ..system.passing.parameters import numbers
from .component import FailedError, Sample


def target_sample(network: Network, link: NodeLink, sample_of: Callable[[Node], Sample]) -> Sample:
    """Return the value that a connection, with the links added to it, transfers to its target. Raises FailedError.

    ``sample_of`` returns the value of a source.
    """
    total = transform(network, link, sample_of(link.source))
    for term in link.added:
        change = term.transformation
        total = float(total) + (float(sample_of(term.source)) * change.factor + change.offset)
    return total


def transform(network: Network, link: NodeLink, sample: Sample) -> Sample:
    """Return a value after a connection's unit conversion and transformation. Raises FailedError."""
    change = link.transformation
    if change == IDENTITY:
        return sample  # texts, and integers that float64 may not represent, stay unchanged
    if not change.table:
        return float(sample) * change.factor + change.offset
    for source, target in numbers(network, link):
        if source == sample:
            return target
    if change.is_partial:
        return sample
    raise FailedError(f"{link.where}: its mapping has no entry for {sample!r}")
