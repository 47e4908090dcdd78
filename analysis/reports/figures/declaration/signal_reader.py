"""Signals, units and words of a figure read against the prepared system."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace

from lxml import etree

from ....common.errors import suggestion
from ....runtime.flight.program import layout_of
from ....runtime.ssp.annotations import AnnotationReader
from ....runtime.ssp.units import Unit
from ....runtime.system.names import elements, parted
from ....runtime.system.prepared import PreparedSystem
from .values import Rows, Signal

NUMBERS = ("Real", "Integer")
ROWS = ("where", "from", "to")
TRUTHS = {"true": True, "false": False}


class LackingError(Exception):
    """An FMU that was put in does not have what a figure is made of."""


class SignalReader(AnnotationReader):
    """What the readers of all figures share; ``notes`` are of the figure that is read."""

    def __init__(self, prepared: PreparedSystem) -> None:
        super().__init__(prepared.network.file)
        self.prepared = prepared
        self.network = prepared.network
        self.put_in = prepared.options.use
        self.types = layout_of(prepared.network, prepared.settings).types
        self.notes: list[str] = []

    def title(self, element: etree._Element, otherwise: str) -> str:
        return element.get("title", "").strip() or otherwise

    def truth(self, element: etree._Element, attribute: str) -> bool:
        """Whether an attribute is true; false where it is not there."""
        text = element.get(attribute, "false").strip()
        if text not in TRUTHS:
            raise self.refuse(element, f"{attribute} {text!r} is neither true nor false", "write one of them")
        return TRUTHS[text]

    def parameter(self, element: etree._Element, attribute: str) -> float:
        """The value that the parameter of an attribute has in this system, in its FMU's unit."""
        return self.parameter_value(element, attribute, element.get(attribute, "").strip())

    def parameter_value(self, element: etree._Element, attribute: str, name: str) -> float:
        """The value of a parameter by its name, of one element where it is a vector's."""
        component, variable = parted(name, self.network.fmus)
        fmu = self.network.fmus.get(component)
        if fmu is None or variable not in fmu.variables or fmu.variables[variable].causality != "parameter":
            remedy = "name one as COMPONENT.VARIABLE"
            raise self.unfit(element, name, f"{attribute} {name}: no such parameter", remedy)
        value = self.prepared.settings.variables.get((component, variable), fmu.variables[variable].start)
        if fmu.variables[variable].type not in NUMBERS:
            raise self.unfit(element, name, f"{attribute} {name} is no number", "name another parameter")
        return float(value)

    def integer(self, element: etree._Element, attribute: str) -> int:
        found = self.number(element, attribute)
        if found is None or not found.is_integer():
            raise self.refuse(element, f"{attribute} {element.get(attribute)} is not a whole number", "mend it")
        return int(found)

    def words(self, element: etree._Element, attribute: str) -> tuple[str, ...]:
        """Words of an attribute with commas between, none of them empty or twice."""
        found = (
            tuple(word.strip() for word in element.get(attribute, "").split(",")) if attribute in element.attrib else ()
        )
        if "" in found or len(set(found)) < len(found):
            raise self.refuse(element, f"{attribute} {element.get(attribute)!r}: a word is empty or twice", "mend it")
        return found

    def limits(self, element: etree._Element, low: str, high: str) -> tuple[float | None, float | None]:
        """Two attributes that bound something, of which either may be missing."""
        least, most = self.number(element, low), self.number(element, high)
        if least is not None and most is not None and not least < most:
            raise self.refuse(element, f"{low} {least:g} is not below {high} {most:g}", "swap them")
        return least, most

    def rows(self, element: etree._Element) -> Rows | None:
        """The rows that a figure is of, from `ROWS`; None for all."""
        if "where" not in element.attrib:
            for name in ROWS[1:]:
                if name in element.attrib:
                    raise self.refuse(element, f"{name} without where", 'write where="..." too, or leave it out')
            return None
        low, high = (self.number(element, name) for name in ROWS[1:])
        if low is None and high is None:
            raise self.refuse(element, "where without from and to", "give one of them, or both")
        if low is not None and high is not None and low > high:
            raise self.refuse(element, f"from {low:g} is above to {high:g}", "swap them")
        return Rows(self.scalar(element, "where"), low, high)

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
        except LackingError as lacking:
            self.notes.append(f"Left out: {lacking}.")
            return None

    def named(self, element: etree._Element, attribute: str, name: str) -> Signal:
        """A scalar among several that an attribute names."""
        if name not in self.types or self.types[name] not in NUMBERS:
            raise self.unfit(element, name, f"{attribute} {name}: no such scalar", suggestion(name, self.types))
        return Signal(name, (name,), self.unit_of(name), 1.0, (0.0,))

    def scalar(
        self,
        element: etree._Element,
        attribute: str,
        types: Collection[str] = NUMBERS,
        *,
        unit: Unit | None = None,
        like: Signal | None = None,
    ) -> Signal:
        found = self.signal(element, attribute, types=types, unit=unit, like=like)
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

    def about(self, element: etree._Element, signal: Signal) -> Signal:
        """A signal less the numbers of the attribute ``about``, which are in its own unit."""
        numbers = self.numbers(element, "about")
        if not numbers:
            return signal
        self.as_many(element, f"about has {len(numbers)} numbers", len(numbers), signal)
        return replace(signal, offsets=tuple(-signal.factor * value for value in numbers))

    def less(self, element: etree._Element, signal: Signal) -> tuple[Signal, Signal | None]:
        """What the attribute ``less`` names: a signal to subtract, or parameters, which go into the first's offsets."""
        name = element.get("less", "").strip()
        component, variable = parted(name, self.network.fmus)
        fmu = self.network.fmus.get(component)
        names = elements(variable, fmu.variables) if fmu is not None else []
        if "less" not in element.attrib or fmu is None or not names or elements(name, self.types):
            return signal, self.signal(element, "less", like=signal) if "less" in element.attrib else None
        self.as_many(element, f"less {name} has {len(names)} elements", len(names), signal)
        own = fmu.units.get(fmu.unit_of(fmu.variables[names[0]]) or "")
        values = Signal(name, tuple(f"{component}.{item}" for item in names), own, 1.0, (0.0,) * len(names))
        like = self.converted(element, f"less {name}", values, signal.unit)
        constants = (self.parameter_value(element, "less", item) for item in values.names)
        pairs = zip(signal.offsets, constants, like.offsets, strict=True)
        offsets = tuple(offset - (like.factor * value + shift) for offset, value, shift in pairs)
        return replace(signal, offsets=offsets), None

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
            return LackingError(f"{problem}, with {self.network.fmus[component].name} as {component}")
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
