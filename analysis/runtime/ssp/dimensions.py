"""Arrays of SSP 2.0: their dimensions in documents, and names of their elements, such as ``x[2,1]``, counted from 1."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

from lxml import etree

from ....common.bounds import ARRAY_ELEMENTS
from ....common.errors import InputError
from .documents import children

Shape = tuple[int, ...]  # () for a scalar
ELEMENT = re.compile(r"(?P<array>.+)\[(?P<index>[1-9]\d*(?:,[1-9]\d*)*)\]")


@dataclass(frozen=True, slots=True)
class Dimension:
    """Dimension of an array: its ``size``, or the connector of the same element that determines it, or neither."""

    size: int | None
    connector: str | None
    line: int


def read_dimensions(element: etree._Element, file: str, name: str, *, fixed: bool = False) -> tuple[Dimension, ...]:
    """Return the dimensions of a connector or parameter, which are empty for a scalar. Raises InputError.

    If ``fixed``, each dimension must state its size.
    """
    dimensions = []
    for dimension in children(element, "ssc:Dimension"):
        size, connector = dimension.get("size"), dimension.get("sizeConnector")
        where = f"{name}, Dimension (line {dimension.sourceline})"
        if size is not None and connector is not None:
            raise InputError(file, where, "has both size and sizeConnector", "remove one")
        if fixed and size is None:
            raise InputError(file, where, "has no size, which only connectors may omit", 'write size="..."')
        dimensions.append(Dimension(None if size is None else int(size), connector, dimension.sourceline))
    if all(each.size is not None for each in dimensions):
        ARRAY_ELEMENTS.check(math.prod(each.size or 0 for each in dimensions), file, name)
    return tuple(dimensions)


def indices(shape: Shape) -> list[Shape]:
    """Return the indices of all elements in row-major order; for a scalar, a single empty index."""
    return list(itertools.product(*(range(1, size + 1) for size in shape)))


def element_name(array: str, index: Shape) -> str:
    """Return the name of an array's element, or the name of a scalar."""
    return f"{array}[{','.join(map(str, index))}]" if index else array


def element_names(array: str, shape: Shape) -> list[str]:
    """Return the names of all elements of an array, in row-major order."""
    return [element_name(array, index) for index in indices(shape)]


def array_shapes(names: Iterable[str]) -> dict[str, Shape]:
    """Return the shapes of the arrays whose elements are all among the names, in order of first appearance."""
    known = dict.fromkeys(names)
    arrays: dict[str, list[Shape]] = {}
    for name in known:
        match = ELEMENT.fullmatch(name)
        if match:
            arrays.setdefault(match["array"], []).append(tuple(map(int, match["index"].split(","))))
    shapes: dict[str, Shape] = {}
    for array, present in arrays.items():
        if array not in known and len({len(index) for index in present}) == 1:
            shape = tuple(map(max, zip(*present, strict=True)))
            if math.prod(shape) == len(present):
                shapes[array] = shape
    return shapes


def text_of(shape: Shape) -> str:
    """Return a shape as text: `a scalar`, `3 elements`, `2 x 3 elements`."""
    if not shape:
        return "a scalar"
    return f"{' x '.join(map(str, shape))} element{'' if shape == (1,) else 's'}"
