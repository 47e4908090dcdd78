"""Reader of a system's three-dimensional scene from its element of the annotation."""

from __future__ import annotations

from collections.abc import Sequence

from lxml import etree

from .....common.errors import suggestion
from ....runtime.ssp.documents import tag
from ....runtime.ssp.names import elements, split_name
from ..declared import Signal
from ..history_readers import METRE
from ..signal_reader import NUMBERS, MissingSignalError, SignalReader
from .arrow_reader import read_arrow
from .attributes import check_length, read_available, read_signal, read_vector
from .body_reader import read_body
from .scene_elements import GROUND, AxisLetter, AxisNames, Geographic, Line, SceneFigure, Site, Surface

SCENE = ("frame", "axes", "up", "title")
SPHERE = ("radius", "centre", "name")
KINDS = ("plane", "sphere")
LOCAL_FRAME, LOCAL_AXES = "local, at the ground below the last sample", ("east", "north", "up")


def read_scene(reader: SignalReader, element: etree._Element) -> SceneFigure:
    """Read the scene.

    Raises InputError with the line, and MissingSignalError if a substituted FMU lacks a body's signal.
    """
    reader.attributes(element, (), SCENE)
    children = reader.parts(element, ("Surface", "Body", "Site", "Line", "Arrow"))
    if any(tag(item) == tag(element) for item in element.itersiblings(preceding=True)):
        raise reader.refuse(element, "a second Scene", "write only one")
    if not children["Body"]:
        raise reader.refuse(element, "no Body", 'write <Body name="..." shape="box" size="1 1 1"/>')
    if len(children["Surface"]) > 1:
        raise reader.refuse(children["Surface"][1], "a second Surface", "write only one")
    surface = _surface(reader, children["Surface"][0]) if children["Surface"] else None
    bodies = tuple(read_body(reader, item, surface) for item in children["Body"])
    local = isinstance(bodies[0].position, Geographic)
    for body, item in zip(bodies, children["Body"], strict=True):
        if isinstance(body.position, Geographic) != local:
            raise reader.refuse(
                item, "bodies have positions of two kinds", "give all bodies longitude, latitude, height, or none"
            )
    if local and children["Surface"] and "centre" in children["Surface"][0].attrib:
        raise reader.refuse(
            children["Surface"][0], "centre cannot be combined with longitude and latitude", "leave out centre"
        )
    sites = read_available(reader, children["Site"], lambda item: _site(reader, item, local))
    named = [*children["Body"], *children["Site"]]
    names = [item.get("name", "").strip() for item in named]
    for index, name in enumerate(names):
        if name in names[:index] or name == GROUND:
            raise reader.refuse(named[index], f"name {name} occurs twice or is reserved", "choose another name")
    available = [*(body.name for body in bodies), *(site.name for site in sites)]
    lines = read_available(reader, children["Line"], lambda item: _line(reader, item, names, available, surface))
    starts = {name: name in available for name in names}
    arrows = read_available(reader, children["Arrow"], lambda item: read_arrow(reader, item, bodies, starts))
    axes, up = _axes(reader, element, local, surface)
    return SceneFigure(
        title=reader.title(element, "Scene"),
        notes=tuple(reader.notes),
        frame=LOCAL_FRAME if local else element.get("frame", "").strip(),
        axes=axes,
        up=up,
        surface=surface,
        bodies=bodies,
        sites=tuple(sites),
        lines=tuple(lines),
        arrows=tuple(arrows),
    )


def _axes(
    reader: SignalReader, element: etree._Element, local: bool, surface: Surface | None
) -> tuple[AxisNames, AxisLetter]:
    """Read the names of the axes, and the letter of the upward axis."""
    frame, frames = element.get("frame", "").strip(), reader.network.frames
    axes, up = tuple(element.get("axes", "x y z").split()), element.get("up", "z").strip()
    for name in ("frame", "axes"):
        if local and name in element.attrib:
            raise reader.refuse(element, f"{name} cannot be combined with longitude and latitude", f"leave out {name}")
    if frame in frames and "axes" in element.attrib:
        raise reader.refuse(element, f"Frame {frame} also declares axes", "leave out axes here")
    if frame and frames and frame not in frames and "axes" not in element.attrib:
        raise reader.refuse(element, f"frame {frame}: no such Frame", suggestion(frame, frames))
    axes = frames.get(frame, axes)
    if len(axes) != 3:
        raise reader.refuse(element, f"axes has {len(axes)} names", "give three, separated by spaces")
    if up not in ("x", "y", "z"):
        raise reader.refuse(element, f"up {up!r} is not an axis", "write x, y or z")
    if up != "z" and surface is not None:
        raise reader.refuse(element, f"up {up} cannot be combined with a Surface, whose normal is z", "leave out up")
    return LOCAL_AXES if local else axes, up


def _surface(reader: SignalReader, element: etree._Element) -> Surface:
    attributes = reader.attributes(element, ("kind",), SPHERE)
    if attributes["kind"] not in KINDS:
        raise reader.refuse(element, f"kind {attributes['kind']!r} is unknown", suggestion(attributes["kind"], KINDS))
    name = attributes.get("name") or GROUND
    if attributes["kind"] == "plane":
        for attribute in SPHERE[:2]:
            if attribute in attributes:
                raise reader.refuse(
                    element, f"a plane has no {attribute}", f'leave out {attribute}, or write kind="sphere"'
                )
        return Surface(name, None, None)
    if "radius" not in attributes:
        raise reader.refuse(element, "a sphere needs a radius", 'write radius="COMPONENT.VARIABLE"')
    radius = reader.parameter(element, "radius")
    if not radius > 0.0:
        raise reader.refuse(element, f"radius {attributes['radius']} is {radius:g}", "name the radius of the ground")
    return Surface(name, radius, read_vector(reader, element, "centre", (0.0, 0.0, -radius)))


def _site(reader: SignalReader, element: etree._Element, local: bool) -> Site:
    name = reader.attributes(element, ("name", "position"))["name"]
    if local:
        raise reader.refuse(element, "a Site needs bodies with position, not longitude and latitude", "remove the Site")
    position = element.get("position", "").strip()
    if position.startswith(tuple("+-.0123456789")):
        return Site(name, read_vector(reader, element, "position"))
    component, variable = split_name(position, reader.network.fmus)
    fmu = reader.network.fmus.get(component)
    names = elements(variable, fmu.variables) if fmu is not None else []
    if fmu is None or not names or any(fmu.variables[item].causality != "parameter" for item in names):
        return Site(name, read_signal(reader, element, "position", 3, METRE))
    declared = fmu.unit_of(fmu.variables[names[0]])
    full = tuple(f"{component}.{item}" for item in names)
    signal = Signal(position, full, declared, 1.0, (0.0,) * len(names))
    check_length(reader, element, "position", signal, 3)
    factor = reader.convert_limits(element, f"position {position}", signal, METRE).factor
    x, y, z = (factor * reader.parameter_value(element, "position", item) for item in full)
    return Site(name, (x, y, z))


def _line(
    reader: SignalReader,
    element: etree._Element,
    names: Sequence[str],
    available: Sequence[str],
    surface: Surface | None,
) -> Line:
    attributes = reader.attributes(element, ("from", "to"), ("name", "while"))
    start, end = attributes["from"], attributes["to"]
    if end == GROUND and surface is None:
        raise reader.refuse(element, "to ground needs a Surface", 'add <Surface kind="plane"/>')
    for attribute, name in (("from", start), ("to", end)):
        if name not in names and not (attribute == "to" and name == GROUND):
            raise reader.refuse(element, f"{attribute} {name}: no such Body or Site", suggestion(name, names))
        if name in names and name not in available:
            raise MissingSignalError(f"{name} is not available")
    condition = reader.scalar(element, "while", (*NUMBERS, "Boolean")) if "while" in attributes else None
    return Line(attributes.get("name") or f"{start} to {end}", start, end, condition)
