"""Attributes of a scene's elements: vectors, signals of a certain size, and optional elements."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeVar

from lxml import etree

from ....runtime.ssp.conversions import BASE_UNITS, Unit
from ..declared import Signal
from ..signal_reader import MissingSignalError, SignalReader
from .scene_elements import Vector

RADIAN = Unit("rad", tuple(int(name == "rad") for name in BASE_UNITS))
Value = TypeVar("Value")


def read_available(
    reader: SignalReader, children: Sequence[etree._Element], read: Callable[[etree._Element], Value]
) -> list[Value]:
    """Return the available elements among optional ones; add notes on the others."""
    readable = []
    for item in children:
        try:
            readable.append(read(item))
        except MissingSignalError as error:
            reader.notes.append(f"Left out: {error}.")
    return readable


def read_signal(
    reader: SignalReader, element: etree._Element, attribute: str, size: int, unit: Unit | None = None
) -> Signal:
    """Read the signal of an attribute with this number of elements, converted to ``unit`` if stated."""
    signal = reader.signal(element, attribute, unit=unit)
    check_length(reader, element, attribute, signal, size)
    return signal


def check_length(reader: SignalReader, element: etree._Element, attribute: str, signal: Signal, size: int) -> None:
    if len(signal.names) != size:
        problem = f"{attribute} {signal.label} has {len(signal.names)} elements, but {size} are required"
        raise reader.signal_error(element, signal.label, problem, "name another signal")


def read_vector(
    reader: SignalReader, element: etree._Element, attribute: str, default: Vector = (0.0, 0.0, 0.0)
) -> Vector:
    """Read the three numbers of an attribute, or the default."""
    if attribute not in element.attrib:
        return default
    numbers = reader.numbers(element, attribute)
    if len(numbers) != 3:
        raise reader.refuse(element, f"{attribute} has {len(numbers)} numbers", "give three")
    x, y, z = numbers
    return x, y, z


def read_direction(reader: SignalReader, element: etree._Element, attribute: str) -> Vector:
    """Read a unit vector from the three numbers of an attribute; the default is the z axis."""
    vector = read_vector(reader, element, attribute, (0.0, 0.0, 1.0))
    length = math.hypot(*vector)
    if length == 0.0:
        raise reader.refuse(element, f"{attribute} has no direction", "give a vector that is not 0")
    x, y, z = (component / length for component in vector)
    return x, y, z
