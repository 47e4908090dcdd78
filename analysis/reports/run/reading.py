"""The figures that a system asks for, from the `org.perilune.report` annotation of its SSD."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace

from lxml import etree

from ...errors import suggestion
from ...flight.program import layout_of
from ...system.annotations import AnnotationReader
from ...system.documents import tag
from ...system.names import elements, parted
from ...system.prepared import PreparedSystem
from ...system.units import BASE_UNITS, Unit
from .declared import Band, Error, Figure, Pulses, Signal, Undrawn

ANNOTATION = "org.perilune.report"
SECOND = Unit("s", tuple(int(name == "s") for name in BASE_UNITS))
NUMBERS = ("Real", "Integer")
INSIDE = "within the band"
BAND = ("low", "high", "unit", "about", "less", "shade", "shade_below", "against", "name", "labels", "title")


def read_figures(prepared: PreparedSystem) -> list[Figure]:
    """What the SSD asks for, in its order, none where it asks for nothing. Raises InputError naming the line.

    What an FMU lacks that was put in by ``use`` is no fault of the SSD: its figure is an `Undrawn` one, or does
    without.
    """
    annotation = prepared.network.description.annotations.get(ANNOTATION)
    return [] if annotation is None else _Reader(prepared).figures(annotation)


class _LackingError(Exception):
    """An FMU that was put in does not have what a figure is made of."""


class _Reader(AnnotationReader):
    def __init__(self, prepared: PreparedSystem) -> None:
        super().__init__(prepared.network.file)
        self.network = prepared.network
        self.put_in = prepared.options.use
        self.types = layout_of(prepared.network, prepared.settings).types
        self.notes: list[str] = []  # of the element that is read

    def figures(self, annotation: etree._Element) -> list[Figure]:
        readers: dict[str, Callable[[etree._Element], Figure]] = {
            "Band": self.band,
            "Pulses": self.pulses,
            "Error": self.error,
        }
        report = self.content(annotation, "Report")
        self.parts(report, readers)
        found: list[Figure] = []
        for element in report.iterchildren(etree.Element):
            self.notes = []
            try:
                found.append(readers[tag(element)](element))
            except _LackingError as lacking:
                found.append(Undrawn(self.title(element, tag(element)), (str(lacking),)))
        return found

    def band(self, element: etree._Element) -> Band:
        found = self.attributes(element, ("signal",), BAND)
        low, high = self.number(element, "low"), self.number(element, "high")
        if low is None and high is None:
            raise self.refuse(element, "neither low nor high", "give one of them, or both")
        if low is not None and high is not None and not low < high:
            raise self.refuse(element, f"low {low:g} is not below high {high:g}", "swap them")
        unit = self.unit(element, found["unit"], found["signal"]) if "unit" in found else None
        signal = self.signal(element, "signal", unit=unit)
        about = tuple(signal.factor * value for value in self.numbers(element, "about"))
        if about:
            self.as_many(element, f"about has {len(about)} numbers", len(about), signal)
            signal = replace(signal, offsets=tuple(-value for value in about))
        if ("shade" in found) != ("shade_below" in found):
            raise self.refuse(element, "shade and shade_below belong together", "give both, or neither")
        return Band(
            title=self.title(element, signal.label),
            notes=tuple(self.notes),
            signal=signal,
            low=low,
            high=high,
            name=found.get("name") or INSIDE,
            about=about,
            labels=self.labels(element, signal),
            less=self.signal(element, "less", like=signal) if "less" in found else None,
            shade=self.scalar(element, "shade") if "shade" in found else None,
            shade_below=self.number(element, "shade_below") or 0.0,
            against=tuple(self.named(element, "against", name) for name in found.get("against", "").split()),
        )

    def named(self, element: etree._Element, attribute: str, name: str) -> Signal:
        """A scalar among several that an attribute names."""
        if name not in self.types or self.types[name] not in NUMBERS:
            raise self.unfit(element, name, f"{attribute} {name}: no such scalar", suggestion(name, self.types))
        return Signal(name, (name,), self.unit_of(name), 1.0, (0.0,))

    def pulses(self, element: etree._Element) -> Pulses:
        self.attributes(element, ("lengths",), ("count", "remainder", "total", "labels", "title"))
        lengths = self.signal(element, "lengths", unit=SECOND)
        return Pulses(
            count=self.scalar(element, "count", ("Integer",)) if "count" in element.attrib else None,
            remainder=self.optional(element, "remainder", lambda name: self.signal(element, name, like=lengths)),
            total=self.optional(element, "total", lambda name: self.scalar(element, name)),
            lengths=lengths,
            labels=self.labels(element, lengths),
            title=self.title(element, lengths.label),
            notes=tuple(self.notes),
        )

    def error(self, element: etree._Element) -> Error:
        self.attributes(element, ("estimate", "truth"), ("sigma", "after", "labels", "title"))
        estimate = self.signal(element, "estimate")
        truth = self.signal(element, "truth", like=estimate)
        return Error(
            estimate=estimate,
            truth=truth,
            sigma=self.optional(element, "sigma", lambda name: self.sigma(element, name, estimate)),
            after=self.number(element, "after"),
            labels=self.labels(element, estimate),
            title=self.title(element, f"{estimate.label} less {truth.label}"),
            notes=tuple(self.notes),
        )

    def title(self, element: etree._Element, otherwise: str) -> str:
        return element.get("title", "").strip() or otherwise

    def labels(self, element: etree._Element, signal: Signal) -> tuple[str, ...]:
        """What the elements of a vector are called: as declared, else by their index; a scalar by nothing."""
        found = tuple(element.get("labels", "").split())
        if not found:
            return tuple(name.removeprefix(signal.label) for name in signal.names)
        self.as_many(element, f"labels has {len(found)} words", len(found), signal)
        return found

    def as_many(self, element: etree._Element, problem: str, size: int, signal: Signal) -> None:
        """Refuses what has not as many parts as a signal has elements."""
        if size != len(signal.names):
            problem = f"{problem}, {signal.label} has {len(signal.names)} elements"
            raise self.unfit(element, signal.label, problem, "give as many")

    def optional(self, element: etree._Element, attribute: str, read: Callable[[str], Signal]) -> Signal | None:
        """A signal that a figure can do without; it says so where an FMU that was put in lacks it."""
        if attribute not in element.attrib:
            return None
        try:
            return read(attribute)
        except _LackingError as lacking:
            self.notes.append(f"Left out: {lacking}.")
            return None

    def scalar(self, element: etree._Element, attribute: str, types: Collection[str] = NUMBERS) -> Signal:
        found = self.signal(element, attribute, types=types)
        if len(found.names) > 1:
            raise self.unfit(element, found.label, f"{attribute} {found.label} is a vector", "name a scalar")
        return found

    def sigma(self, element: etree._Element, attribute: str, estimate: Signal) -> Signal:
        """A standard deviation, which as a difference of values has no offset."""
        found = self.signal(element, attribute, like=estimate)
        return replace(found, offsets=(0.0,) * len(found.names))

    def signal(
        self,
        element: etree._Element,
        attribute: str,
        *,
        unit: Unit | None = None,
        like: Signal | None = None,
        types: Collection[str] = NUMBERS,
    ) -> Signal:
        """The recorded signal that an attribute names, in its own unit or in ``unit``.

        A signal ``like`` it has as many elements, and its unit is taken.
        """
        name = element.get(attribute, "").strip()
        what = f"{attribute} {name}"
        names = tuple(elements(name, self.types))
        if not names:
            raise self.unfit(element, name, f"{what}: no such signal", suggestion(name, self.types))
        if any(self.types[item] not in types for item in names):
            raise self.unfit(element, name, f"{what} is not {' or '.join(types)}", "name another signal")
        own = self.unit_of(names[0])
        if any(self.unit_of(item) != own for item in names):
            raise self.unfit(element, name, f"{what}: its elements differ in unit", "name one of them")
        found = Signal(name, names, own, 1.0, (0.0,) * len(names))
        if like is not None:
            self.as_many(element, f"{what} has {len(names)} elements", len(names), like)
            unit = like.unit
        return found if unit is None and like is None else self.converted(element, what, found, unit)

    def converted(self, element: etree._Element, what: str, signal: Signal, unit: Unit | None) -> Signal:
        own = signal.unit
        if own is None and unit is None:
            return signal
        if own is None or unit is None or not own.fits(unit):
            got, wanted = (found.name if found is not None else "none" for found in (own, unit))
            problem = f"{what}: its unit is {got}, asked for is {wanted}"
            raise self.unfit(element, signal.label, problem, "correct the unit, or name another signal")
        factor, offset = own.conversion_to(unit)
        return Signal(signal.label, signal.names, unit, factor, (offset,) * len(signal.names))

    def unfit(self, element: etree._Element, name: str, problem: str, remedy: str) -> Exception:
        """What to raise of a signal: a refusal, unless its FMU was put in."""
        component, _ = parted(name, self.network.fmus)
        if component in self.put_in:
            return _LackingError(f"{problem}, with {self.network.fmus[component].name} as {component}")
        return self.refuse(element, problem, remedy)

    def unit_of(self, name: str) -> Unit | None:
        """The unit of a recorded signal: its connector's, else what the FMU says of an output that is none."""
        node = self.network.nodes.get(name)
        if node is not None:
            return node.unit
        component, variable = parted(name, self.network.fmus)
        fmu = self.network.fmus[component]
        return fmu.units.get(fmu.unit_of(fmu.variables[variable]) or "")

    def unit(self, element: etree._Element, name: str, signal: str) -> Unit:
        """A unit by its name: of the SSD, or of the FMU that a signal is of."""
        component, _ = parted(signal, self.network.fmus)
        known = self.network.fmus[component].units if component else {}
        known = known | self.network.description.units
        if name not in known:
            raise self.refuse(element, f"unit {name} is not defined", "define it under Units of the SSD")
        return known[name]
