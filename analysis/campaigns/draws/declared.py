"""What drawing needs to know of a campaign: its draws, and what is derived of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np


@dataclass(frozen=True)
class Draw:
    """One draw: the values it fills (``names``), its distribution and that one's arguments.

    ``names`` is the draw's own name, except for correlated_normal, which fills several. A name
    with a dot is a component's parameter; others are for [derive] and the metrics only.
    ``arguments`` are floats, or tuples of floats, under the keys of the campaign file.
    """

    name: str
    distribution: str
    names: tuple[str, ...]
    arguments: Mapping[str, Any]


class Formula(Protocol):
    """An expression over draws; ``where`` (file, element) is what errors name."""

    @property
    def text(self) -> str: ...
    @property
    def where(self) -> tuple[str, str]: ...
    def evaluate(self, values: Mapping[str, Any]) -> Any: ...


class Declared(Protocol):
    """A campaign, as far as its draws go. ``derived`` are formulas over draws and earlier derived values."""

    @property
    def file(self) -> str: ...
    @property
    def trials(self) -> int: ...
    @property
    def seed(self) -> int: ...
    @property
    def draws(self) -> Sequence[Draw]: ...
    @property
    def derived(self) -> Mapping[str, Formula]: ...


Columns = dict[str, np.ndarray]


def drawn_names(campaign: Declared) -> list[str]:
    """The values that the draws fill, in their order."""
    return [name for draw in campaign.draws for name in draw.names]
