"""Nodes of quantities over time: all variants in one figure, each variant, constant quantities."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from ....cell import Quantity
from ....common.colours import Look
from ....model import Group, Node, Note
from ....pictures import Figure, Figures
from ..variant_distributions import overlaid_figures
from .band_figures import band_figures, overlaid_bands
from .histories import History

Styles = Mapping[str, Look]


def overlaid_histories(histories: Sequence[History], styles: Styles) -> list[Node]:
    """Return a figure of all variants for each quantity; none if no quantity has several variants."""
    several = [each for each in histories if each.constant is None and len(each.bands) > 1]

    def draw() -> list[Figure]:
        return [
            figure
            for each in several
            for figure in overlaid_bands(each.quantity, each.bands, styles, f"{each.name}-all")
        ]

    return [overlaid_figures(draw, styles)] if several else []


def histories_by_variant(histories: Sequence[History], styles: Styles) -> list[Node]:
    """Return a group for each quantity, with a figure per variant."""
    return [
        Group(
            each.quantity.label,
            [Figures(partial(band_figures, each.quantity, each.bands, styles, each.name))],
            level=4,
        )
        for each in histories
        if each.constant is None
    ]


def constant_notes(histories: Sequence[History]) -> list[Node]:
    """Return a note on the quantities that never change."""
    return [
        Note([
            f"{each.quantity.label} is ",
            Quantity(each.constant, each.quantity.unit),
            " throughout all these flights.",
        ])
        for each in histories
        if each.constant is not None
    ]  # fmt: skip
