"""Reader of a scene's arrow: origin, signal, axes of its components, length and colour."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lxml import etree

from .....common.errors import suggestion
from ...common.colours import HUES
from ..signal_reader import MissingSignalError, SignalReader
from .attributes import read_signal
from .scene_elements import Arrow, Body, ThrustAxis

ARROW_REQUIRED = ("name", "from", "signal")
ARROW_OPTIONAL = ("frame", "length", "colour")


def read_arrow(
    reader: SignalReader, element: etree._Element, bodies: Sequence[Body], starts: Mapping[str, bool]
) -> Arrow:
    """Return the arrow; ``starts`` maps the names of bodies and sites to True if they are available.

    Raises InputError with the line, and MissingSignalError if a substituted FMU lacks the signal or the site.
    """
    attributes = reader.attributes(element, ARROW_REQUIRED, ARROW_OPTIONAL)
    start, colour = attributes["from"], attributes.get("colour")
    if start not in starts:
        raise reader.refuse(element, f"from {start}: no such Body or Site", suggestion(start, starts))
    if colour is not None and colour not in HUES:
        raise reader.refuse(element, f"colour {colour} is unknown", suggestion(colour, HUES))
    frame = _read_frame(reader, element, bodies)
    length = reader.number(element, "length", positive=True)
    signal = read_signal(reader, element, "signal", 3)
    if not starts[start]:
        raise MissingSignalError(f"{start} is not available")
    return Arrow(attributes["name"], start, signal, frame, length, colour)


def _read_frame(reader: SignalReader, element: etree._Element, bodies: Sequence[Body]) -> str | None:
    """Read the body along whose axes the components are; None for the axes of the scene."""
    if "frame" not in element.attrib:
        return None
    name = element.get("frame", "").strip()
    body = next((each for each in bodies if each.name == name), None)
    if body is None:
        names = [each.name for each in bodies]
        problem = f"frame {name}: no such Body"
        raise reader.refuse(element, problem, f"{suggestion(name, names)}; leave out frame for the axes of the scene")
    if body.attitude is None or isinstance(body.attitude, ThrustAxis):
        reason = "no attitude" if body.attitude is None else "an axis alone, whose roll is unknown"
        raise reader.refuse(element, f"frame {name}: this Body has {reason}", "name a Body with an attitude")
    return name
