"""Reader of a scene's body: position and attitude in one of their forms, thrust and jets."""

from __future__ import annotations

from lxml import etree

from .....common.errors import suggestion
from ....runtime.ssp.types import WHOLE
from ..history_readers import METRE, SECOND
from ..signal_reader import SignalReader
from .attributes import RADIAN, read_available, read_direction, read_signal, read_vector
from .scene_elements import (
    SHAPES,
    Angles,
    Attitude,
    Body,
    Cartesian,
    Geographic,
    Jets,
    Panel,
    Position,
    Quaternion,
    Surface,
    Thrust,
    ThrustAxis,
    Vector,
    WindAngles,
)

GEOGRAPHIC = ("longitude", "latitude", "height")
WIND = ("bank", "sideslip_angle", "angle_of_attack", "flight_path_angle", "heading")
ATTITUDES = (("quaternion",), ("angles", "sequence"), ("axis",), WIND)
BODY = ("at", "position", *GEOGRAPHIC, *(name for names in ATTITUDES for name in names))
NOZZLE = ("at", "along")
PANEL = ("at", "size")
JETS = ("forces", "pulses", "count", "couple")


def read_body(reader: SignalReader, element: etree._Element, surface: Surface | None) -> Body:
    attributes = reader.attributes(element, ("name", "shape", "size"), BODY)
    if attributes["shape"] not in SHAPES:
        raise reader.refuse(element, f"shape {attributes['shape']} is unknown", suggestion(attributes["shape"], SHAPES))
    size = _read_size(reader, element)
    children = reader.parts(element, ("Thrust", "Jets", "Panel"))
    position = _position(reader, element, surface)
    return Body(
        name=attributes["name"],
        shape=attributes["shape"],
        size=size,
        at=read_vector(reader, element, "at"),
        position=position,
        attitude=_attitude(reader, element, position),
        thrusts=tuple(read_available(reader, children["Thrust"], lambda item: _thrust(reader, item))),
        jets=tuple(read_available(reader, children["Jets"], lambda item: _jets(reader, item))),
        panels=tuple(_panel(reader, item) for item in children["Panel"]),
    )


def _read_size(reader: SignalReader, element: etree._Element) -> Vector:
    """Read the positive extents (m) of a body or a panel."""
    size = read_vector(reader, element, "size")
    if not all(extent > 0.0 for extent in size):
        raise reader.refuse(element, f"size {element.get('size')} is not positive", "give three positive lengths in m")
    return size


def _panel(reader: SignalReader, element: etree._Element) -> Panel:
    reader.attributes(element, ("size",), ("at",))
    return Panel(read_vector(reader, element, "at"), _read_size(reader, element))


def _position(reader: SignalReader, element: etree._Element, surface: Surface | None) -> Position | None:
    named = [name for name in GEOGRAPHIC if name in element.attrib]
    if not named:
        return Cartesian(read_signal(reader, element, "position", 3, METRE)) if "position" in element.attrib else None
    if "position" in element.attrib or len(named) < len(GEOGRAPHIC):
        raise reader.refuse(element, "needs either position, or longitude, latitude, height", "give one of the two")
    if surface is None or surface.radius is None:
        raise reader.refuse(element, "longitude needs a sphere", 'add <Surface kind="sphere" radius="..."/>')
    longitude, latitude = (reader.scalar(element, name, unit=RADIAN) for name in GEOGRAPHIC[:2])
    return Geographic(longitude, latitude, reader.scalar(element, "height", unit=METRE))


def _attitude(reader: SignalReader, element: etree._Element, position: Position | None) -> Attitude | None:
    declared = [names for names in ATTITUDES if any(name in element.attrib for name in names)]
    if not declared:
        return None
    if len(declared) > 1:
        forms = " and ".join(names[0] for names in declared)
        raise reader.refuse(element, f"has attitudes of two kinds, {forms}", "give one of them")
    for name in declared[0]:
        if name not in element.attrib:
            raise reader.refuse(element, f"{declared[0][0]} without {name}", f'also write {name}="..."')
    match declared[0][0]:
        case "quaternion":
            return Quaternion(read_signal(reader, element, "quaternion", 4))
        case "angles":
            return _angles(reader, element)
        case "axis":
            return ThrustAxis(read_signal(reader, element, "axis", 3))
    if not isinstance(position, Geographic):
        raise reader.refuse(
            element, "wind angles need longitude, latitude and height", "give these three, or another attitude"
        )
    return WindAngles(*(reader.scalar(element, name, unit=RADIAN) for name in WIND))


def _angles(reader: SignalReader, element: etree._Element) -> Angles:
    """Read the angles of an attitude: a vector, or scalars separated by spaces."""
    sequence, names = element.get("sequence", "").strip(), element.get("angles", "").split()
    if not 0 < len(sequence) <= 3 or not set(sequence) <= {"x", "y", "z"}:
        raise reader.refuse(
            element, f"sequence {sequence!r} does not have one to three axes", 'write for instance "zyx"'
        )
    if len(names) == 1:
        return Angles((read_signal(reader, element, "angles", len(sequence), RADIAN),), sequence)
    if len(names) != len(sequence):
        problem = f"angles has {len(names)} signals, but sequence has {len(sequence)} axes"
        raise reader.refuse(element, problem, "give one signal for each axis, in the order of the rotations")
    signals = (reader.find_signal(element, "angles", name) for name in names)
    return Angles(
        tuple(reader.convert_limits(element, f"angles {signal.label}", signal, RADIAN) for signal in signals), sequence
    )


def _thrust(reader: SignalReader, element: etree._Element) -> Thrust:
    reader.attributes(element, ("signal",), NOZZLE)
    at, along = read_vector(reader, element, "at"), read_direction(reader, element, "along")
    return Thrust(reader.scalar(element, "signal"), at, along)


def _jets(reader: SignalReader, element: etree._Element) -> Jets:
    attributes = reader.attributes(element, (), JETS)
    if ("forces" in attributes) == ("pulses" in attributes):
        raise reader.refuse(element, "needs either forces or pulses", "give one of the two")
    pulses = "pulses" in attributes
    if "count" in attributes and not pulses:
        raise reader.refuse(element, "count needs pulses", "leave out count")
    signal = reader.signal(element, "pulses", unit=SECOND) if pulses else reader.signal(element, "forces")
    nozzles = reader.parts(element, ("Jet",))["Jet"]
    reader.check_size(element, f"it has {len(nozzles)} Jet", len(nozzles), signal)
    for item in nozzles:
        reader.attributes(item, NOZZLE)
    return Jets(
        signal=signal,
        at=tuple(read_vector(reader, item, "at") for item in nozzles),
        along=tuple(read_direction(reader, item, "along") for item in nozzles),
        pulses=pulses,
        count=reader.scalar(element, "count", WHOLE) if "count" in attributes else None,
        couple=reader.truth(element, "couple"),
    )
