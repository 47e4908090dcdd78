"""Reader of a figure's signals, units and names, checked against the prepared system."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace

from lxml import etree

from ....common.errors import suggestion
from ...runtime.flight.program import make_layout
from ...runtime.ssp.annotations import AnnotationReader
from ...runtime.ssp.conversions import Unit
from ...runtime.ssp.names import elements, split_name
from ...runtime.ssp.types import WHOLE
from ...runtime.system.prepared import PreparedSystem
from ..common.signals import displayed_name, names_of_elements
from .declared import SampleRange, Signal

NUMBERS = ("Real", *WHOLE)
ROWS = ("where", "from", "to")
TRUTHS = {"true": True, "false": False}


class MissingSignalError(Exception):
    """Error for a signal of a figure that a substituted FMU lacks."""


class SignalReader(AnnotationReader):
    """Reader common to the elements of all figures; ``notes`` belong to the current figure."""

    def __init__(self, prepared: PreparedSystem) -> None:
        super().__init__(prepared.network.file)
        self.prepared = prepared
        self.network = prepared.network
        self.substituted = prepared.options.use
        self.types = make_layout(prepared.network, prepared.settings).types
        self.notes: list[str] = []

    def title(self, element: etree._Element, otherwise: str) -> str:
        return element.get("title", "").strip() or otherwise

    def truth(self, element: etree._Element, attribute: str) -> bool:
        """Read a Boolean attribute; the default is false."""
        text = element.get(attribute, "false").strip()
        if text not in TRUTHS:
            raise self.refuse(element, f"{attribute} {text!r} is neither true nor false", "write true or false")
        return TRUTHS[text]

    def parameter(self, element: etree._Element, attribute: str) -> float:
        """Return the value of the parameter named by an attribute, in the unit of its FMU."""
        return self.parameter_value(element, attribute, element.get(attribute, "").strip())

    def parameter_value(self, element: etree._Element, attribute: str, name: str) -> float:
        """Return the value of a parameter, or of an element of a vector, by name."""
        component, variable = split_name(name, self.network.fmus)
        fmu = self.network.fmus.get(component)
        if fmu is None or variable not in fmu.variables or fmu.variables[variable].causality != "parameter":
            remedy = "name a parameter as COMPONENT.VARIABLE"
            raise self.signal_error(element, name, f"{attribute} {name}: no such parameter", remedy)
        value = self.prepared.settings.variables.get((component, variable), fmu.variables[variable].start_text)
        if fmu.variables[variable].type not in NUMBERS:
            raise self.signal_error(element, name, f"{attribute} {name} is not a number", "name another parameter")
        return float(value)

    def integer(self, element: etree._Element, attribute: str) -> int:
        value = self.number(element, attribute)
        if value is None or not value.is_integer():
            raise self.refuse(
                element, f"{attribute} {element.get(attribute)} is not an integer", "write a whole number"
            )
        return int(value)

    def words(self, element: etree._Element, attribute: str) -> tuple[str, ...]:
        """Read the comma-separated names of an attribute; empty and repeated names are rejected."""
        names = (
            tuple(token.strip() for token in element.get(attribute, "").split(","))
            if attribute in element.attrib
            else ()
        )
        if "" in names or len(set(names)) < len(names):
            raise self.refuse(
                element, f"{attribute} {element.get(attribute)!r}: a name is empty or repeated", "write different names"
            )
        return names

    def limits(self, element: etree._Element, low: str, high: str) -> tuple[float | None, float | None]:
        """Read two attributes that are optional limits."""
        minimum, maximum = self.number(element, low), self.number(element, high)
        if minimum is not None and maximum is not None and not minimum < maximum:
            raise self.refuse(element, f"{low} = {minimum:g} is not below {high} = {maximum:g}", "swap them")
        return minimum, maximum

    def rows(self, element: etree._Element) -> SampleRange | None:
        """Read the selection of a figure's samples from the attributes `ROWS`; None for all."""
        if "where" not in element.attrib:
            for name in ROWS[1:]:
                if name in element.attrib:
                    raise self.refuse(element, f"{name} needs where", f'also write where="...", or leave out {name}')
            return None
        low, high = (self.number(element, name) for name in ROWS[1:])
        if low is None and high is None:
            raise self.refuse(element, "where needs from or to", "give from, to or both")
        if low is not None and high is not None and low > high:
            raise self.refuse(element, f"from = {low:g} is above to = {high:g}", "swap them")
        return SampleRange(self.scalar(element, "where"), low, high)

    def labels(self, element: etree._Element, signal: Signal) -> tuple[str, ...]:
        """Return one label per element: the figure's labels, else the frame's axis names, else indices.

        A scalar has one empty label.
        """
        labels = tuple(element.get("labels", "").split())
        if not labels and self.displayed(signal.names[0]) == signal.label:
            return ("",)
        if not labels:
            axes = names_of_elements(signal.names, self.network.axes)
            return axes or tuple(name.removeprefix(signal.label) for name in signal.names)
        self.check_size(element, f"labels has {len(labels)} names", len(labels), signal)
        return labels

    def check_size(self, element: etree._Element, problem: str, size: int, signal: Signal) -> None:
        """Check that a signal has ``size`` elements. Raises InputError."""
        if size != len(signal.names):
            problem = f"{problem}, {signal.label} has {len(signal.names)} elements"
            raise self.signal_error(element, signal.label, problem, f"give {len(signal.names)}")

    def displayed(self, name: str) -> str:
        """Return a signal's name as displayed in figures."""
        return displayed_name(name, self.network.axes)

    def optional(self, element: etree._Element, attribute: str, read: Callable[[str], Signal]) -> Signal | None:
        """Read an optional signal; None, with a note, if a substituted FMU lacks it."""
        if attribute not in element.attrib:
            return None
        try:
            return read(attribute)
        except MissingSignalError as error:
            self.notes.append(f"Left out: {error}.")
            return None

    def find_signal(self, element: etree._Element, attribute: str, name: str) -> Signal:
        """Read one scalar among several named by an attribute."""
        if name not in self.types or self.types[name] not in NUMBERS:
            is_there = name in self.types
            problem = f"{attribute} {name}: {'not a numeric scalar' if is_there else 'no such scalar'}"
            numeric = [each for each, kind in self.types.items() if kind in NUMBERS]
            raise self.signal_error(element, name, problem, suggestion(name, numeric))
        return Signal(self.displayed(name), (name,), self.network.unit_of(name), 1.0, (0.0,))

    def scalar(
        self,
        element: etree._Element,
        attribute: str,
        types: Collection[str] = NUMBERS,
        *,
        unit: Unit | None = None,
        like: Signal | None = None,
    ) -> Signal:
        signal = self.signal(element, attribute, types=types, unit=unit, like=like)
        if len(signal.names) > 1:
            raise self.signal_error(element, signal.label, f"{attribute} {signal.label} is a vector", "name a scalar")
        return signal

    def signal(
        self,
        element: etree._Element,
        attribute: str,
        *,
        unit: Unit | None = None,
        like: Signal | None = None,
        types: Collection[str] = NUMBERS,
    ) -> Signal:
        """Read the recorded signal named by an attribute, in its unit or converted to ``unit``.

        With ``like`` it must have as many elements as this other signal, and is converted to the other's unit.
        """
        name = element.get(attribute, "").strip()
        what = f"{attribute} {name}"
        names = tuple(elements(name, self.types))
        if not names:
            raise self.signal_error(element, name, f"{what}: no such signal", suggestion(name, self.types))
        if any(self.types[item] not in types for item in names):
            raise self.signal_error(element, name, f"{what} is not {' or '.join(types)}", "name another signal")
        unit_of_first = self.network.unit_of(names[0])
        if any(self.network.unit_of(item) != unit_of_first for item in names):
            raise self.signal_error(element, name, f"{what}: its elements differ in unit", "name one element")
        signal = Signal(self.displayed(name), names, unit_of_first, 1.0, (0.0,) * len(names))
        if like is not None:
            self.check_size(element, f"{what} has {len(names)} elements", len(names), like)
            unit = like.unit
        return signal if unit is None and like is None else self.convert_limits(element, what, signal, unit)

    def about(self, element: etree._Element, signal: Signal) -> Signal:
        """Return a signal minus the numbers of the attribute ``about``, which are in the signal's unit."""
        numbers = self.numbers(element, "about")
        if not numbers:
            return signal
        self.check_size(element, f"about has {len(numbers)} numbers", len(numbers), signal)
        return replace(signal, offsets=tuple(-signal.factor * value for value in numbers))

    def less(self, element: etree._Element, signal: Signal) -> tuple[Signal, Signal | None]:
        """Read the signal of the attribute ``less``; a parameter changes the offsets of the first signal instead."""
        name = element.get("less", "").strip()
        component, variable = split_name(name, self.network.fmus)
        fmu = self.network.fmus.get(component)
        names = elements(variable, fmu.variables) if fmu is not None else []
        if "less" not in element.attrib or fmu is None or not names or elements(name, self.types):
            return signal, self.signal(element, "less", like=signal) if "less" in element.attrib else None
        self.check_size(element, f"less {name} has {len(names)} elements", len(names), signal)
        unit = fmu.unit_of(fmu.variables[names[0]])
        values = Signal(name, tuple(f"{component}.{item}" for item in names), unit, 1.0, (0.0,) * len(names))
        like = self.convert_limits(element, f"less {name}", values, signal.unit)
        constants = (self.parameter_value(element, "less", item) for item in values.names)
        pairs = zip(signal.offsets, constants, like.offsets, strict=True)
        offsets = tuple(offset - (like.factor * value + shift) for offset, value, shift in pairs)
        return replace(signal, offsets=offsets), None

    def convert_limits(self, element: etree._Element, what: str, signal: Signal, unit: Unit | None) -> Signal:
        declared = signal.unit
        if declared is None and unit is None:
            return signal
        if declared is None or unit is None or not declared.is_convertible(unit):
            actual, required = (each.name if each is not None else "none" for each in (declared, unit))
            problem = f"{what}: its unit is {actual}, but {required} is required"
            raise self.signal_error(element, signal.label, problem, "correct the unit, or name another signal")
        factor, offset = declared.conversion_to(unit)
        return Signal(signal.label, signal.names, unit, factor, (offset,) * len(signal.names))

    def signal_error(self, element: etree._Element, name: str, problem: str, remedy: str) -> Exception:
        """Return the error for a signal: MissingSignalError if its FMU was substituted, else InputError."""
        component, _ = split_name(name, self.network.fmus)
        if component in self.substituted:
            return MissingSignalError(f"{problem}, with {self.network.fmus[component].name} as {component}")
        return self.refuse(element, problem, remedy)

    def unit(self, element: etree._Element, name: str, signal: str) -> Unit:
        """Return a unit by name, from the SSD or the signal's FMU."""
        component, _ = split_name(signal, self.network.fmus)
        known = self.network.fmus[component].units if component else {}
        known = known | self.network.description.units
        if name not in known:
            raise self.refuse(element, f"unit {name} is not defined", "define it under Units of the SSD")
        return known[name]
