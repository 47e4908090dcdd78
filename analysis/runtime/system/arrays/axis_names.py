"""Names of axes and of vector elements, from the annotation `org.perilune.frames` of an SSD."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from lxml import etree

from .....common.errors import suggestion
from ...ssp.annotations import AnnotationReader
from ...ssp.names import elements, split_name, vectors
from ..network import Network

ANNOTATION = "org.perilune.frames"
FRAME = re.compile(r"\(([^()]+) frame\)\s*$")  # end of a variable's description
DIMENSIONS = (2, 3)


def read_frames(network: Network, substituted: Collection[str]) -> None:
    """Read the names of axes by frame, and of elements by signal, into a network. Raises InputError with the line.

    A vector belongs to the frame that lists it, or to the frame whose name ends the vector's description in the FMU, as
    in ``(landing site frame)``, if the vector has one element for each axis. Listed vectors may be missing in
    ``substituted`` components.
    """
    annotation = network.description.annotations.get(ANNOTATION)
    if annotation is None:
        return
    reader = FrameReader(network, substituted)
    children = reader.parts(reader.content(annotation, "Frames"), ("Frame", "Vector"))
    for element in children["Frame"]:
        reader.read_frame(element)
    for element in children["Frame"]:  # lists take precedence over descriptions
        reader.read_listed(element, "axes")
    for element in children["Vector"]:
        reader.attributes(element, ("signals", "elements"))
        reader.read_listed(element, "elements")


class FrameReader(AnnotationReader):
    """Reader of the annotation; ``described`` contains elements of vectors, by the frame in their descriptions."""

    def __init__(self, network: Network, substituted: Collection[str]) -> None:
        super().__init__(network.file)
        self.network = network
        self.substituted = substituted
        self.known = dict.fromkeys(network.nodes) | dict.fromkeys(
            f"{component}.{name}" for component, fmu in network.fmus.items() for name in fmu.variables
        )
        self.described = described_vectors(network, self.known)
        self.listed: set[str] = set()

    def read_frame(self, element: etree._Element) -> None:
        """Read a frame, and name the elements of the vectors with descriptions that refer to it."""
        name = self.attributes(element, ("name", "axes"), ("signals",))["name"]
        axes = self.names(element, "axes")
        if name in self.network.frames:
            raise self.refuse(element, f"a second Frame {name}", "write only one")
        if len(axes) not in DIMENSIONS:
            raise self.refuse(element, f"axes has {len(axes)} names", "write two or three names, one for each axis")
        self.network.frames[name] = axes
        if name not in self.described and not (element.get("signals") or self.substituted):
            remedy = f'{suggestion(name, self.described)}, or list its vectors: signals="COMPONENT.VECTOR"'
            raise self.refuse(element, f"frame {name}: no variable's description names it", remedy)
        inside = [members for members in self.described.get(name, []) if len(members) in DIMENSIONS]
        largest = max(inside, key=len, default=[])
        if len(largest) > len(axes) or (largest and not self.substituted):
            self.check_count(element, "axes", axes, largest)
        for members in inside:
            if len(members) == len(axes):
                self.network.axes.update(zip(members, axes, strict=True))

    def read_listed(self, element: etree._Element, attribute: str) -> None:
        """Name the elements of the vectors that an XML element lists as ``signals``."""
        names = self.names(element, attribute)
        for signal in element.get("signals", "").split():
            members = one_dimensional(signal, self.known)
            if not members and split_name(signal, self.network.fmus)[0] in self.substituted:
                continue
            if not members:
                raise self.refuse(element, f"signals {signal}: no such vector", suggestion(signal, vectors(self.known)))
            if signal in self.listed:
                raise self.refuse(element, f"signals {signal} is listed twice", "leave one out")
            self.check_count(element, attribute, names, members)
            self.listed.add(signal)
            self.network.axes.update(zip(members, names, strict=True))

    def names(self, element: etree._Element, attribute: str) -> tuple[str, ...]:
        """Return the distinct, space-separated names in an attribute."""
        names = tuple(element.get(attribute, "").split())
        twice = [name for name in names if names.count(name) > 1]
        if twice:
            raise self.refuse(element, f"{attribute}: {twice[0]} occurs twice", "give each axis a different name")
        return names

    def check_count(self, element: etree._Element, attribute: str, names: Collection[str], members: list[str]) -> None:
        """Raise an error unless there is exactly one name for each element of a vector."""
        if len(names) != len(members):
            problem = (
                f"{attribute} has {len(names)} names, but {members[0].removesuffix('[1]')} has {len(members)} elements"
            )
            raise self.refuse(element, problem, "write one name for each element")


def one_dimensional(name: str, known: Collection[str]) -> list[str]:
    """Return the known elements ``name[1]``, ``name[2]`` ... of a vector; an empty list for a matrix or a scalar."""
    members = elements(name, known)
    return [] if members in ([], [name]) or "," in members[0][len(name) :] else members


def described_vectors(network: Network, known: Collection[str]) -> dict[str, list[list[str]]]:
    """Return the elements of vectors, grouped by the frame that is named at the end of their descriptions."""
    by_frame: dict[str, list[list[str]]] = {}
    for component, fmu in network.fmus.items():
        for name, variable in fmu.variables.items():
            frame = FRAME.search(variable.description or "") if name.endswith("[1]") else None
            if frame is not None:
                members = one_dimensional(f"{component}.{name.removesuffix('[1]')}", known)
                by_frame.setdefault(frame[1], []).append(members)
    return by_frame


def names_of_axes(network: Network, signals: Iterable[str]) -> dict[str, str]:
    """Return the names of axes by signal, for the signals that have one."""
    return {name: network.axes[name] for name in signals if name in network.axes}
