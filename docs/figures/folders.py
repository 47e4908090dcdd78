"""Figure docs/images/architecture/folders.svg: the order of folders and their imports."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Curve

from perilune.analysis.documents.common.colours import BLUE, INK
from perilune.analysis.documents.common.style import house_style, new_figure
from perilune.common.paths import ROOT
from tests.folders import FOLDERS, folder_of, importing_files, module_of

from .pictures import IMAGES, write_picture

ROW = 0.17  # in


def folders_figure() -> Figure:
    """Return a figure of the folders from top to bottom, with an arc for each pair with imports."""
    rows = _rows()
    order = {name: position for position, name in enumerate(rows)}
    figure = new_figure(ROW * len(rows) + 0.2)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, 100.0), ylim=(len(rows), -1.0))
    axes.axis("off")
    for name, position in order.items():
        axes.text(33.0, position, name, ha="right", va="center", fontsize=7.5, color=INK, family="monospace")
        axes.plot(34.5, position, "o", color=BLUE, markersize=3.5)
    for here, there in sorted(_imports()):
        _arc(axes, order[here], order[there])
    return figure


def _rows() -> list[str]:
    """Return the folders; the folders of blocks are one row."""
    return list(dict.fromkeys(_row_of(name) for name in FOLDERS))


def _row_of(folder: str) -> str:
    return "fmus_src/plants and other kinds" if FOLDERS[folder].startswith("blocks: ") else folder


def _imports() -> set[tuple[str, str]]:
    """Return the pairs of folders with imports, except imports of `common`, which every folder has."""
    rows = {
        (_row_of(folder_of(module_of(ROOT / file))), _row_of(folder_of(module)))
        for pairs in importing_files().values()
        for file, module in pairs
    }
    return {(here, there) for here, there in rows if here != there and there != "common"}


def _arc(axes: Axes, start: int, end: int) -> None:
    """Draw the arc of an import; longer arcs are farther out."""
    right = 36.0 + 2.6 * (end - start)
    points = [(35.5, start), (right, start), (right, end), (35.5, end)]
    codes = [Curve.MOVETO, Curve.CURVE4, Curve.CURVE4, Curve.CURVE4]
    patch = PathPatch(Curve(points, codes), fill=False, edgecolor=BLUE, linewidth=0.6)
    axes.add_patch(patch)


if __name__ == "__main__":
    with house_style():
        print(write_picture(folders_figure(), IMAGES / "architecture" / "folders.svg"))
