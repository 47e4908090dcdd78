"""Selection of a stability study's content for paper: all content for few loops, the essential figures for many."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ...pictures import Figure
from .shared import SharedFigures

FEW = 3  # largest number of loops with separate figures for which everything is printed
MOST = 40  # largest number of printed figures for more loops
KINDS_BY_IMPORTANCE = (  # kinds of figures by importance: first figures, sensitivities next to tables, figures in a row
    ("Bode", "Nichols"),
    ("Sensitivities",),
    ("Nyquist", "Poles", "Poles near z = 1", "Step response"),
)
FIRST = "Bode"  # kind of figure that every loop has


@dataclass(frozen=True)
class Paper:
    """Selection for paper.

    ``kinds`` are the kinds of figures to print. None selects all figures, and all tables of loops with separate
    figures.
    """

    kinds: tuple[str, ...] | None

    @property
    def words(self) -> str:
        """Sentences on content that is omitted on paper."""
        if self.kinds is None:
            return "Printed without the tables of loops whose figures are shown with another loop."
        return (
            f"On paper: {', '.join(self.kinds)} of each loop, and the classical and robust margins of loops with "
            "separate figures. The screen shows the other figures and tables."
        )

    def mark_printed(self, figures: Sequence[Figure]) -> list[Figure]:
        """Return figures marked as printed or not printed."""
        return [replace(figure, is_printed=self.kinds is None or kind_of(figure) in self.kinds) for figure in figures]

    def is_table_printed(self, part: str, shared: SharedFigures) -> bool:
        """Return True if the table of a part is printed."""
        return has_separate_figures(shared) and (self.kinds is None or part in ("classical", "robust"))


def kind_of(figure: Figure) -> str:
    """Return the label of a figure without the names of its loops."""
    return figure.label.partition(":")[0]


def has_separate_figures(shared: SharedFigures) -> bool:
    """Return True if a loop has separate figures instead of references to another loop's figures."""
    return FIRST in [kind_of(figure) for figures in shared.figures.values() for figure in figures]


def paper_of(shared: Sequence[SharedFigures]) -> Paper:
    """Return the selection for loops: everything for up to `FEW`, else kinds of figures up to a total number."""
    if sum(map(has_separate_figures, shared)) <= FEW:
        return Paper(None)
    labels = [kind_of(figure) for one in shared for figures in one.figures.values() for figure in figures]
    kinds: list[str] = []
    for tier in KINDS_BY_IMPORTANCE:
        if kinds and sum(labels.count(kind) for kind in (*kinds, *tier)) > MOST:
            break
        kinds += tier
    return Paper(tuple(kinds))
