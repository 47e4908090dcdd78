"""What of the loops' sections is printed: all of a few loops, of many what a board asks for first.

On the screen everything is there. A printed report has to stay short enough to be read.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..common.panels import Panel
from .shared import Shared

FEW = 3  # loops with figures of their own that are printed in full
MOST = 40  # figures of the others
TIERS = (  # the first are seen at first sight, sensitivities stand beside the tables, the others are a row
    ("Bode", "Nichols"),
    ("Sensitivities",),
    ("Nyquist", "Poles", "Poles near z = 1", "Step response"),
)
FIRST = "Bode"  # which every loop has


@dataclass(frozen=True)
class Paper:
    """``kinds``: the figures that are printed; None: all, and the tables of the loops that draw their own."""

    kinds: tuple[str, ...] | None

    @property
    def words(self) -> str:
        """What is left out, for the reader of the paper."""
        if self.kinds is None:
            return "Printed without the tables of loops whose figures are shown with another loop."
        return (
            f"On paper, of each loop: {', '.join(self.kinds)}; classical and robust margins of those with figures of "
            "their own. The screen has the other figures and tables."
        )

    def screen_only(self, panels: Sequence[Panel]) -> list[str]:
        """Labels of the panels that are not printed."""
        if self.kinds is None:
            return []
        return [panel.label for panel in panels if panel.label.partition(":")[0] not in self.kinds]

    def prints(self, part: str, shared: Shared) -> bool:
        """Whether the table of a part is printed."""
        return draws(shared) and (self.kinds is None or part in ("classical", "robust"))


def draws(shared: Shared) -> bool:
    """Whether a loop has figures of its own and does not share another one's."""
    return any(panel.label.partition(":")[0] == FIRST for panels in shared.panels.values() for panel in panels)


def paper_of(shared: Sequence[Shared]) -> Paper:
    """All of FEW loops; otherwise kinds of figures in their order, as long as they are not too many."""
    if sum(map(draws, shared)) <= FEW:
        return Paper(None)
    labels = [panel.label.partition(":")[0] for one in shared for panels in one.panels.values() for panel in panels]
    kinds: list[str] = []
    for tier in TIERS:
        if kinds and sum(labels.count(kind) for kind in (*kinds, *tier)) > MOST:
            break
        kinds += tier
    return Paper(tuple(kinds))
