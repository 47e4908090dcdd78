"""Reader of a system's declaration of its loops, the `org.perilune.stability` annotation of its SSD."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields

from lxml import etree

from ....common.errors import suggestion
from ...runtime.ssp.annotations import AnnotationReader
from ...runtime.ssp.system_description import SystemDescription
from ...runtime.system.options import Layer
from ..loops.describing_function import ELEMENTS, complete_parameters
from .declaration import Declaration, LoopDeclaration, MarginLimits, NonlinearElement, PointDeclaration, Sweep

ANNOTATION = "org.perilune.stability"
LAYER_ELEMENTS = ("Use", "ParameterSet", "Set")


def read_declaration(description: SystemDescription) -> Declaration:
    """Return the declaration in the SSD, empty if there is none. Raises InputError with the line."""
    annotation = description.annotations.get(ANNOTATION)
    if annotation is None:
        return Declaration()
    return _RequestReader(description.file).declaration(annotation)


class _RequestReader(AnnotationReader):
    def declaration(self, annotation: etree._Element) -> Declaration:
        children = self.parts(self.content(annotation, "Stability"), ("Limits", "Point", "Loop", "Sweep"))
        points = tuple(self.point(item) for item in children["Point"])
        loops = tuple(self.loop(item, {point.name for point in points}) for item in children["Loop"])
        by_name = {loop.name: loop for loop in loops}
        sweeps = tuple(self.sweep(item, by_name) for item in children["Sweep"])
        for items, elements in ((points, children["Point"]), (loops, children["Loop"]), (sweeps, children["Sweep"])):
            names = [item.name for item in items]
            for position, name in enumerate(names):
                if name in names[:position]:
                    raise self.refuse(elements[position], f"the name {name} occurs twice", "choose another name")
        return Declaration(self.limits(children["Limits"]), points, loops, sweeps)

    def limits(self, elements: list[etree._Element]) -> MarginLimits:
        names = [item.name for item in fields(MarginLimits)]
        values: dict[str, float | None] = {}
        for element in elements:
            self.attributes(element, (), names)
            values |= {
                name: self.number(element, name, positive=True) for name in names if element.get(name) is not None
            }
        return MarginLimits(**values)  # type: ignore[arg-type]

    def point(self, element: etree._Element) -> PointDeclaration:
        values = self.attributes(element, ("name",), ("time", "signal", "falls_to", "until", "phase"))
        if ("signal" in values) != ("falls_to" in values) or ("signal" in values) == ("time" in values):
            raise self.refuse(element, "needs either a time, or a signal and falls_to", "give one of the two")
        time, until = self.number(element, "time"), self.number(element, "until")
        if time is not None and until is not None and until <= time:
            raise self.refuse(element, f"until = {until:g} s is not after time = {time:g} s", "give a later until")
        return PointDeclaration(
            name=values["name"],
            time=time,
            signal=values.get("signal"),
            falls_to=self.number(element, "falls_to"),
            until=until,
            phase=values.get("phase", ""),
            layer=self.layer(self.parts(element, LAYER_ELEMENTS)),
        )

    def layer(self, children: Mapping[str, list[etree._Element]]) -> Layer:
        return Layer(
            use=self.pairs(children["Use"], "component", "fmu"),
            parameters=tuple(self.attributes(item, ("source",))["source"] for item in children["ParameterSet"]),
            set=self.pairs(children["Set"], "name", "value"),
            places={item.get("name", "").strip(): (self.file, item.sourceline or 0) for item in children["Set"]},
        )

    def pairs(self, elements: list[etree._Element], key: str, value: str) -> dict[str, str]:
        """Return two attributes of each element as a mapping; duplicates are rejected."""
        values: dict[str, str] = {}
        for element in elements:
            item = self.attributes(element, (key, value))
            if item[key] in values:
                raise self.refuse(element, f"{item[key]} is given twice", "give each name once")
            values[item[key]] = item[value]
        return values

    def loop(self, element: etree._Element, points: set[str]) -> LoopDeclaration:
        values = self.attributes(
            element,
            ("name", "cut", "points"),
            ("direction", "direction_rate", "ahead", "returned", "period", "amplitude"),
        )
        if ("direction_rate" in values) != ("ahead" in values) or ("ahead" in values and "direction" not in values):
            raise self.refuse(
                element, "direction_rate and ahead must be given together, and with a direction", "give all three"
            )
        names = tuple(values["points"].split())
        for name in names:
            if name not in points:
                raise self.refuse(element, f"no point {name}", suggestion(name, points))
        if len(set(names)) < len(names):
            raise self.refuse(element, "a point is given twice", "give each name once")
        return LoopDeclaration(
            name=values["name"],
            cut=values["cut"],
            points=names,
            direction=values.get("direction"),
            direction_rate=values.get("direction_rate"),
            ahead=self.number(element, "ahead") or 0.0,
            returned=values.get("returned"),
            period=self.number(element, "period", positive=True),
            amplitude=self.number(element, "amplitude", positive=True),
            elements=tuple(self.element(item) for item in self.parts(element, ("Element",))["Element"]),
        )

    def element(self, element: etree._Element) -> NonlinearElement:
        name, kind = element.get("name", "").strip(), element.get("kind", "").strip()
        if not name:
            raise self.refuse(element, "no name", 'write name="..."')
        if kind not in ELEMENTS:
            raise self.refuse(element, f"unknown kind {kind!r}", suggestion(kind, ELEMENTS))
        values = {
            str(key): self.number(element, str(key)) or 0.0 for key in element.attrib if key not in ("name", "kind")
        }
        try:
            complete_parameters(kind, values)
        except ValueError as error:
            raise self.refuse(element, str(error), "correct this element") from error
        return NonlinearElement(name, kind, values, self.layer(self.parts(element, LAYER_ELEMENTS)))

    def sweep(self, element: etree._Element, loops: dict[str, LoopDeclaration]) -> Sweep:
        values = self.attributes(element, ("name", "loop", "point", "parameter", "low", "high"))
        loop = loops.get(values["loop"])
        if loop is None or values["point"] not in loop.points:
            raise self.refuse(element, "no such loop at this point", suggestion(values["loop"], loops))
        low, high = self.number(element, "low"), self.number(element, "high")
        if low is None or high is None or not low < high:
            raise self.refuse(element, f"low = {low} is not below high = {high}", "swap them")
        return Sweep(values["name"], values["loop"], values["point"], values["parameter"], low, high)
