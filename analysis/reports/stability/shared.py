"""Which figures of loops stand on the page and on paper.

Figures that are the same for several loops, as those of three identical axes, are drawn once. Two figures are the same
if they say the same words, have the same lines and marks, and no point of one lies further than `TOLERANCE` from where
it is in the other: less than half the width of a line.

On the screen everything is there. A printed report has to stay short enough to be read: of a few loops all is printed,
of many what a board asks for first.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from ...stability.results.report import LoopReport
from ..common.panels import Panel

TOLERANCE = 0.5  # pt; lines of responses are 1.3 pt wide
NAMES = re.compile(r'\b(?:id|aria-label)="[^"]*"|(?<=href=")#[^"]*|url\(#[^)]*\)')
PLACES = re.compile(r'\b(d|x|y|width|height|transform|points)="([^"]*)"')
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
Panels = dict[str, list[Panel]]  # by the part of a loop's section that they belong to


@dataclass(frozen=True)
class Picture:
    """What is drawn: everything but names and places, and the places (pt)."""

    strokes: str
    places: np.ndarray


@dataclass(frozen=True)
class Shared:
    """The figures of a loop that are drawn there, and by the number of another loop what is drawn there for it."""

    panels: Panels
    elsewhere: dict[int, list[str]]


@dataclass
class _Drawn:
    panel: Panel
    picture: Picture
    loops: list[int]


def picture_of(figure: Markup) -> Picture:
    """A figure without the names of its elements, which differ between all figures of a page."""
    places: list[str] = []

    def keep(match: re.Match[str]) -> str:
        places.extend(NUMBER.findall(match[2]))
        return f'{match[1]}="{NUMBER.sub("", match[2])}"'

    strokes = PLACES.sub(keep, NAMES.sub("", figure))
    return Picture(strokes, np.array(places, dtype=float))


def alike(one: Picture, other: Picture) -> bool:
    """Whether nobody could tell two pictures apart."""
    if one.strokes != other.strokes or one.places.size != other.places.size:
        return False
    return bool(np.max(np.abs(one.places - other.places), initial=0.0) <= TOLERANCE)


def share(loops: Sequence[LoopReport], figures: Sequence[Panels]) -> list[Shared]:
    """What each loop's section draws, ``figures`` being those of each: a figure stands with the first that has it."""
    plotted: dict[str, list[_Drawn]] = {}
    retained: list[dict[str, list[_Drawn]]] = []
    elsewhere: list[dict[int, list[str]]] = [{} for _ in loops]
    for index, parts in enumerate(figures):
        retained.append({key: [] for key in parts})
        for key, panels in parts.items():
            for panel in panels:
                picture = picture_of(Markup().join(drawing.svg for drawing in panel.figure.drawings))
                same = next((one for one in plotted.get(panel.label, []) if alike(one.picture, picture)), None)
                if same is None:
                    one = _Drawn(panel, picture, [index])
                    plotted.setdefault(panel.label, []).append(one)
                    retained[-1][key].append(one)
                elif same.loops[0] != index:
                    same.loops.append(index)
                    elsewhere[index].setdefault(same.loops[0], []).append(panel.label)
    return [
        Shared({key: [_title(one, loops) for one in pictures] for key, pictures in parts.items()}, away)
        for parts, away in zip(retained, elsewhere, strict=True)
    ]


def _title(one: _Drawn, loops: Sequence[LoopReport]) -> Panel:
    """A panel whose label names its loops where there are several."""
    if len(one.loops) == 1:
        return one.panel
    return Panel(f"{one.panel.label}: {together([loops[index] for index in one.loops])}", one.panel.figure)


def together(loops: Sequence[LoopReport]) -> str:
    """Names of loops, the elements of a vector brought together, with their operating points where these differ."""
    points = len({loop.point for loop in loops}) > 1
    stems: dict[tuple[str, str], list[str]] = {}
    for loop in loops:
        stem, bracket, index = loop.name.partition("[")
        stems.setdefault((stem, f" at {loop.point}" if points else ""), []).append(bracket + index)
    return ", ".join(f"{stem}{', '.join(indices)}{point}" for (stem, point), indices in stems.items())


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
