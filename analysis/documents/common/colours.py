"""Colours of figures (Okabe and Ito, distinguishable by colour-blind readers) and of light and dark pages.

Style sheets receive them as custom properties from `colour_properties`, scripts from web/generated/colours.ts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ..interactive import measures

if TYPE_CHECKING:
    from matplotlib.typing import LineStyleType


class Shade(NamedTuple):
    """A colour of a page in its light and its dark version."""

    light: str
    dark: str


BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"
COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, "#000000")  # instead of yellow, which is too pale on white
HUES = {
    "blue": BLUE,
    "vermilion": VERMILION,
    "green": GREEN,
    "purple": PURPLE,
    "orange": ORANGE,
    "sky": SKY,
}  # colours by their names in declarations
INK, FAINT, GRID = "#222222", "#6b6b6b", "#dddddd"  # colours of figures
SHIP = {
    "foil": "#c8a040",
    "metal": "#c9ced4",
    "dark": "#4a4f57",
    "shield": "#6b4a36",
    "panel": "#27408b",
    "mark": "#d9480f",
}  # colours of bodies in scenes
SHADES = {
    "ink": Shade("#222", "#e6e6e6"),  # text
    "paper": Shade("#fff", "#141414"),  # the page
    "note": Shade("#555", "#b0b0b0"),
    "link": Shade("#0059a0", "#6db3f2"),
    "outline": Shade("#ccc", "#4a4a4a"),
    "row": Shade("#e4e4e4", "#3a3a3a"),  # lines below rows of tables
    "edge": Shade("#999", "#777"),
    "bar": Shade("#777", "#999"),
    "button": Shade("#f6f6f6", "#262626"),
    "muted": Shade("#666", "#a8a8a8"),
    "empty": Shade("#aaa", "#666"),  # frame of empty items
    "track": Shade("#f0f0f0", "#2a2a2a"),
    "replay": Shade("#ddd", "#444"),
    "good": Shade("#eef5fa", "#14293a"),  # background of a status
    "bad": Shade("#fdf1e9", "#3a2415"),
    "pass": Shade("#00694d", "#4cc38a"),  # colours of verdicts
    "fail": Shade("#a84300", "#ff9a5a"),
    "withheld": Shade("#7a5c00", "#e0b94a"),
    "faint": Shade("#6b6b6b", "#a8a8a8"),  # axes
    "grid": Shade("#e4e4e4", "#333"),
    "brush": Shade("rgb(0 0 0 / 10%)", "rgb(255 255 255 / 14%)"),
    "scene_veil": Shade("rgb(238 242 246 / 75%)", "rgb(13 17 23 / 75%)"),
    "scene_button": Shade("#f3f4f6", "#2b2f36"),
    "scene_edge": Shade("#9aa0a6", "#6b7280"),
    "pressed": Shade("#0059a0", "#4dabf7"),
    "on_pressed": Shade("#fff", "#10151c"),
    "scene_sky": Shade("#eef2f6", "#0d1117"),
    "scene_ground": Shade("#d8d4cc", "#3a3936"),
    "scene_haze": Shade("#e6e5e2", "#23252a"),
    "scene_grid": Shade("#8f8a80", "#7d7a74"),
    "flame": Shade("#e8590c", "#ffa94d"),
    "failed": Shade("#222222", "#f1f3f5"),  # paths of failures
}


def colour_properties() -> str:
    """Return `SHADES` and `HUES` as custom properties of CSS: scene_veil becomes --scene-veil."""
    shades = (f"--{name.replace('_', '-')}: light-dark({light}, {dark});" for name, (light, dark) in SHADES.items())
    hues = (f"--{name}: {colour};" for name, colour in HUES.items())
    return ":root {\n  " + "\n  ".join((*shades, *hues)) + "\n}\n"


DASHES: tuple[LineStyleType, ...] = tuple((0, each) if each else "-" for each in measures.DASHES)
MARKERS = "osD^vPX"


class Look(NamedTuple):
    """Style of a series; two series differ in colour, dashes and marker at once."""

    colour: str
    dashes: LineStyleType
    marker: str

    @property
    def lengths(self) -> tuple[float, ...]:
        """The lengths of dashes and gaps, in multiples of the line width."""
        return () if isinstance(self.dashes, str) else tuple(self.dashes[1] or ())


def look(index: int) -> Look:
    """Return the look of the index-th series."""
    return Look(COLOURS[index % len(COLOURS)], DASHES[index % len(DASHES)], MARKERS[index % len(MARKERS)])
