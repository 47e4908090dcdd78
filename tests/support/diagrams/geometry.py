"""Geometry of a block diagram, read from its SVG independently of the code that drew it."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from itertools import combinations, pairwise

from lxml import etree

SVG = "{http://www.w3.org/2000/svg}"
EXACT = 0.02  # px: positions have two decimals


@dataclass(frozen=True)
class Box:
    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other: Box) -> bool:
        return (
            self.left < other.right - EXACT
            and other.left < self.right - EXACT
            and self.top < other.bottom - EXACT
            and other.top < self.bottom - EXACT
        )

    def holds(self, other: Box) -> bool:
        return (
            self.left <= other.left + EXACT
            and self.top <= other.top + EXACT
            and self.right >= other.right - EXACT
            and self.bottom >= other.bottom - EXACT
        )


@dataclass(frozen=True)
class Line:
    """An edge: its connections as (source, target) names, and its corners."""

    connections: tuple[tuple[str, str], ...]
    points: tuple[tuple[float, float], ...]

    @property
    def segments(self) -> list[Box]:
        return [
            Box(min(a[0], b[0]), min(a[1], b[1]), max(a[0], b[0]), max(a[1], b[1])) for a, b in pairwise(self.points)
        ]


class Drawing:
    """Blocks, labels and lines of an <svg> element, in its own coordinates."""

    def __init__(self, svg: str) -> None:
        self.root = etree.fromstring(svg)
        self.frames = [self._rect(each) for each in self._all("rect")]
        self.lines = [self._line(group) for group in self._groups("edge")]
        self.labels = [(each.text, self._label(each)) for each in self._all("text")]
        self.parameters = [self._pairs(group) for group in self._groups("parameter")]
        self.blocks = {}
        for group in self._groups("block"):
            texts = [self._label(each) for each in group.iter(f"{SVG}text")]
            inside = [frame for frame in self.frames if all(frame.holds(text) for text in texts)]
            self.blocks[group.get("data-block")] = min(inside, key=lambda box: box.right - box.left)
        self.terminals: dict[str, list[Box]] = {}
        for group in self._groups("terminal"):
            name = json.loads(group.get("data-signals"))[0]
            self.terminals.setdefault(name, []).append(self._rect(group.find(f"{SVG}rect")))

    def labels_of(self, block: str) -> list[tuple[str, Box]]:
        """Return the labels inside a block."""
        return [(text, box) for text, box in self.labels if self.blocks[block].holds(box)]

    def connections(self) -> list[tuple[str, str]]:
        """Return all connections, drawn or in the list of a block."""
        pairs = [pair for line in self.lines for pair in line.connections]
        return pairs + [pair for pairs in self.parameters for pair in pairs]

    def _all(self, tag: str) -> list[etree._Element]:
        return list(self.root.iter(f"{SVG}{tag}"))

    def _groups(self, kind: str) -> list[etree._Element]:
        return [group for group in self._all("g") if group.get("class") == kind]

    def _offset(self, element: etree._Element) -> tuple[float, float]:
        x = y = 0.0
        for parent in element.iterancestors():
            if shift := re.fullmatch(r"translate\((\S+) (\S+)\)", parent.get("transform", "")):
                x, y = x + float(shift[1]), y + float(shift[2])
        return x, y

    def _rect(self, element: etree._Element) -> Box:
        dx, dy = self._offset(element)
        x, y, width, height = (float(element.get(name)) for name in ("x", "y", "width", "height"))
        return Box(x + dx, y + dy, x + dx + width, y + dy + height)

    def _label(self, element: etree._Element) -> Box:
        """Return the box from the ascenders' to the descenders' height of DejaVu Sans, as wide as the text is set."""
        dx, dy = self._offset(element)
        x, y, size, width = (float(element.get(name)) for name in ("x", "y", "font-size", "textLength"))
        return Box(x + dx, y + dy - 0.76 * size, x + dx + width, y + dy + 0.24 * size)

    def _pairs(self, group: etree._Element) -> list[tuple[str, str]]:
        sources, targets = (json.loads(group.get(name)) for name in ("data-signals", "data-targets"))
        return list(zip(sources, targets, strict=True))

    def _line(self, group: etree._Element) -> Line:
        path = next(each for each in group.iter(f"{SVG}path") if each.get("class") == "whole-line")
        dx, dy = self._offset(path)
        numbers = [float(number) for number in re.findall(r"-?[\d.]+(?:e-?\d+)?", path.get("d"))]
        points = tuple((x + dx, y + dy) for x, y in zip(numbers[::2], numbers[1::2], strict=True))
        return Line(tuple(self._pairs(group)), points)


def assert_readable(drawing: Drawing) -> None:
    """Assert that lines are orthogonal and cross no block, blocks and labels do not overlap, no
    line covers that of other ports."""
    terminals = [box for boxes in drawing.terminals.values() for box in boxes]
    blocks = [*drawing.blocks.values(), *terminals]
    for one, other in combinations(blocks, 2):
        assert not one.overlaps(other) or one.holds(other) or other.holds(one)
    for (text, one), (other_text, other) in combinations(drawing.labels, 2):
        assert not one.overlaps(other), f"{text} over {other_text}"
    for text, label in drawing.labels:
        assert any(frame.holds(label) for frame in drawing.frames), text
    view = [float(number) for number in drawing.root.get("viewBox").split()]
    page = Box(view[0], view[1], view[0] + view[2], view[1] + view[3])
    for box in (*drawing.frames, *(segment for line in drawing.lines for segment in line.segments)):
        assert page.holds(box)
    for line in drawing.lines:
        for segment in line.segments:
            assert segment.left == segment.right or segment.top == segment.bottom
            for name, block in drawing.blocks.items():
                inside = any(target.startswith(f"{name}.") for pair in line.connections for target in pair)
                assert not _crosses(segment, block) or (inside and _is_frame(drawing, block)), (line, name)
            for block in terminals:
                assert not _crosses(segment, block)
    for one, other in combinations(drawing.lines, 2):
        if one.points[0] != other.points[0] and one.points[-1] != other.points[-1]:
            assert not any(_covers(a, b) for a in one.segments for b in other.segments), (one, other)


def _is_frame(drawing: Drawing, block: Box) -> bool:
    """Return True if there are blocks inside."""
    return any(other != block and block.holds(other) for other in drawing.blocks.values())


def _crosses(segment: Box, block: Box) -> bool:
    """Return True if a line has points inside a block; its ends are on the border."""
    return (
        segment.left < block.right - EXACT
        and segment.right > block.left + EXACT
        and segment.top < block.bottom - EXACT
        and segment.bottom > block.top + EXACT
    )


def _covers(one: Box, other: Box) -> bool:
    """Return True if two lines have more than a point in common."""
    if one.left == one.right and other.left == other.right and abs(one.left - other.left) < 1.0:
        return min(one.bottom, other.bottom) - max(one.top, other.top) > EXACT
    if one.top == one.bottom and other.top == other.bottom and abs(one.top - other.top) < 1.0:
        return min(one.right, other.right) - max(one.left, other.left) > EXACT
    return False
