"""Texts in a chart, of the supported kinds; all others raise UnstatedError."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.colors import to_hex, to_rgba
from matplotlib.patches import BoxStyle
from matplotlib.text import Annotation, Text

from perilune.analysis.documents.interactive.charts import Backing, ChartNote
from tests.support.figures.unstated import UnstatedError

OF_AXES = {"data": False, "axes fraction": True}


def read_note(axes: Axes, text: Text) -> ChartNote:
    """Read a text with its position; a point of the data is inside the axes."""
    if text.get_rotation() != 0.0 or text.get_path_effects() or getattr(text, "arrow_patch", None) is not None:
        raise UnstatedError("a turned text, or one with an arrow")
    if "\n" in text.get_text() or text.get_fontstyle() != "normal":
        raise UnstatedError("a text of several lines or in italics")
    at, of_axes, offset = _annotation_position(text) if isinstance(text, Annotation) else _text_position(axes, text)
    for each, is_of_axes, (low, high) in zip(at, of_axes, (axes.get_xlim(), axes.get_ylim()), strict=True):
        if not is_of_axes and not min(low, high) <= each <= max(low, high):
            raise UnstatedError("a text beside the axes")
    return ChartNote(
        text=text.get_text(),
        at=at,
        of_axes=of_axes,
        offset=offset,
        align=(text.get_horizontalalignment(), text.get_verticalalignment()),
        colour=to_hex(text.get_color()),
        size=float(text.get_fontsize()),
        bold=text.get_fontweight() in ("bold", 700),
        backing=_backing(text),
    )


Position = tuple[tuple[float, float], tuple[bool, bool], tuple[float, float]]


def _annotation_position(text: Annotation) -> Position:
    systems = text.xycoords if isinstance(text.xycoords, tuple) else (text.xycoords, text.xycoords)
    if not all(isinstance(each, str) and each in OF_AXES for each in systems):
        raise UnstatedError(f"a text at {text.xycoords}")
    if text.anncoords == "offset points":
        offset: Any = text.xyann
    elif text.anncoords == text.xycoords and tuple(text.xyann) == tuple(text.xy):
        offset = (0.0, 0.0)
    else:
        raise UnstatedError("a text away from its point")
    of_axes = (OF_AXES[str(systems[0])], OF_AXES[str(systems[1])])
    return (float(text.xy[0]), float(text.xy[1])), of_axes, (float(offset[0]), float(offset[1]))


def _text_position(axes: Axes, text: Text) -> Position:
    if text.get_transform() not in (axes.transData, axes.transAxes):
        raise UnstatedError("a text neither over the data nor over the axes")
    is_of_axes = text.get_transform() is axes.transAxes
    x, y = text.get_position()
    return (float(x), float(y)), (is_of_axes, is_of_axes), (0.0, 0.0)


def _backing(text: Text) -> Backing | None:
    box = text.get_bbox_patch()
    if box is None:
        return None
    style, edge = box.get_boxstyle(), to_rgba(box.get_edgecolor())
    if not isinstance(style, BoxStyle.Square) or edge[3] > 0.0:
        raise UnstatedError("a text in a frame")
    fill = to_rgba(box.get_facecolor())
    return Backing(to_hex(fill), float(fill[3]), style.pad * float(text.get_fontsize()))
