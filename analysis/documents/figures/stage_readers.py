"""Readers of figures of phases, limits and budgets, from elements of the annotation."""

from __future__ import annotations

from collections.abc import Sequence

from lxml import etree

from ....common.errors import suggestion
from ...design.trajectories.declared_bound import read_inputs
from ...design.trajectories.stored_bound import MissingBound, find_bound
from ...runtime.ssp.documents import tag
from ...runtime.ssp.types import WHOLE
from ...runtime.system.prepared import PreparedSystem
from .declared import (
    LANDING,
    MEASURES,
    BoundValues,
    BudgetFigure,
    BudgetItem,
    FigureDeclaration,
    Limit,
    LimitsFigure,
    PhasesFigure,
    SequencerPhase,
)
from .history_readers import SECOND
from .signal_reader import NUMBERS, MissingSignalError, SignalReader


def bound_values(prepared: PreparedSystem) -> BoundValues | None:
    """Return the stored bound of a system and its values; None if its SSD declares none. Raises InputError."""
    inputs, bound = read_inputs(prepared), find_bound(prepared)
    if inputs is None or bound is None:
        return None
    names = tuple(dict.fromkeys([LANDING, *(name.partition(".")[0] for name in inputs if "." in name)]))
    if isinstance(bound, MissingBound):
        return BoundValues(names, {}, bound.reason)
    return BoundValues(names, {LANDING: bound.propellant, **bound.pieces})


def read_phases(reader: SignalReader, element: etree._Element) -> PhasesFigure:
    attributes = reader.attributes(element, ("signal",), ("spent", "status", "status_times", "title"))
    if "status" in attributes and "status_times" in attributes:
        raise reader.refuse(element, "has both status and status_times", "give one of the two")
    parts = reader.parts(element, ("Phase", "Meaning"))
    signal = reader.scalar(element, "signal", WHOLE)
    return PhasesFigure(
        title=reader.title(element, signal.label),
        signal=signal,
        phases=_phases(reader, element, parts["Phase"]),
        spent=reader.optional(element, "spent", lambda name: reader.scalar(element, name)),
        status=reader.optional(element, "status", lambda name: reader.scalar(element, name, WHOLE)),
        status_times=reader.optional(element, "status_times", lambda name: reader.signal(element, name, unit=SECOND)),
        meanings=_meanings(reader, parts["Meaning"]),
        notes=tuple(reader.notes),
    )


def _phases(
    reader: SignalReader, element: etree._Element, parts: Sequence[etree._Element]
) -> tuple[SequencerPhase, ...]:
    if not parts:
        raise reader.refuse(element, "no Phase", 'write <Phase value="1" name="..."/>')
    phases: list[SequencerPhase] = []
    open_ended: set[int] = set()  # values that no later Phase can share
    for part in parts:
        name = reader.attributes(part, ("value", "name"), ("until",))["name"]
        value = reader.integer(part, "value")
        if any(name == phase.name for phase in phases):
            raise reader.refuse(part, f"name {name} occurs twice", "choose another name")
        if value in open_ended:
            raise reader.refuse(
                part, f"value {value}: the preceding Phase of this value lacks until", 'add until="..." there'
            )
        until = None
        if "until" in part.attrib:
            until = reader.scalar(part, "until", (*NUMBERS, "Boolean"))
        else:
            open_ended.add(value)
        phases.append(SequencerPhase(value, name, until))
    for phase, part in zip(phases, parts, strict=True):
        if phase.value not in open_ended:
            raise reader.refuse(part, f"the last Phase of value {phase.value} has until", "add the Phase that follows")
    return tuple(phases)


def _meanings(reader: SignalReader, parts: Sequence[etree._Element]) -> dict[int, str]:
    meanings: dict[int, str] = {}
    for part in parts:
        says = reader.attributes(part, ("value", "says"))["says"]
        value = reader.integer(part, "value")
        if value in meanings:
            raise reader.refuse(part, f"value {value} occurs twice", "name each status once")
        meanings[value] = says
    return meanings


def read_limits(reader: SignalReader, element: etree._Element) -> LimitsFigure:
    reader.attributes(element, (), ("title", "when"))
    parts = reader.parts(element, ("Limit",))["Limit"]
    if not parts:
        raise reader.refuse(element, "no Limit", 'write <Limit signal="..." most="..."/>')
    limits = tuple(_limit(reader, part) for part in parts)
    return LimitsFigure(
        title=reader.title(element, "Limits"),
        limits=limits,
        when=reader.scalar(element, "when", (*NUMBERS, "Boolean")) if "when" in element.attrib else None,
        notes=tuple(reader.notes),
    )


def _limit(reader: SignalReader, element: etree._Element) -> Limit:
    attributes = reader.attributes(element, ("signal",), ("least", "most", "unit", "name", "measure", "about", "less"))
    measure = attributes.get("measure")
    if measure is not None and measure not in MEASURES:
        raise reader.refuse(element, f"measure {measure} is unknown", suggestion(measure, MEASURES))
    minimum, maximum = reader.limits(element, "least", "most")
    if minimum is None and maximum is None:
        raise reader.refuse(element, "has neither least nor most", "give least, most or both")
    unit = reader.unit(element, attributes["unit"], attributes["signal"]) if "unit" in attributes else None
    signal = reader.signal(element, "signal", unit=unit)
    if measure is None and len(signal.names) > 1:
        remedy = f"name a scalar, or write measure={' or '.join(f'{name!r}' for name in MEASURES)}"
        raise reader.signal_error(element, signal.label, f"signal {signal.label} is a vector", remedy)
    if "about" in attributes and "less" in attributes:
        raise reader.refuse(element, "has both about and less", "give one of the two")
    signal = reader.about(element, signal)
    signal, less = reader.less(element, signal)
    return Limit(signal, attributes.get("name") or signal.label, minimum, maximum, less, measure)


def read_budget(reader: SignalReader, element: etree._Element, before: Sequence[FigureDeclaration]) -> BudgetFigure:
    """Read a budget of phases that are declared before it."""
    reader.attributes(element, (), ("title",))
    declared = [item for item in element.itersiblings(preceding=True) if tag(item) == "Phases"]
    if len(declared) != 1:
        problem = f"{len(declared)} Phases elements precede it, but it needs exactly one"
        raise reader.refuse(element, problem, 'write one <Phases spent="..."> before Budget')
    if "spent" not in declared[0].attrib:
        raise reader.refuse(element, "the preceding Phases lacks the attribute spent", 'add spent="..." to Phases')
    phases = [figure for figure in before if isinstance(figure, PhasesFigure) and figure.spent is not None]
    if not phases:
        raise MissingSignalError("the consumption of phases is not available")
    parts = reader.parts(element, ("Item",))["Item"]
    if not parts:
        raise reader.refuse(element, "no Item", 'write <Item name="..." phases="..."/>')
    bound = bound_values(reader.prepared)
    names = [phase.name for phase in phases[0].phases]
    items = tuple(_item(reader, part, names, bound) for part in parts)
    return BudgetFigure(title=reader.title(element, "Budget"), of=phases[0], items=items, bound=bound, notes=())


def _item(
    reader: SignalReader, element: etree._Element, phases: Sequence[str], bound: BoundValues | None
) -> BudgetItem:
    attributes = reader.attributes(element, ("name",), ("phases", "plus", "minus"))
    named, plus, minus = (reader.words(element, name) for name in ("phases", "plus", "minus"))
    if not named and not plus and not minus:
        raise reader.refuse(element, "has neither phases nor plus nor minus", "give one or more of these attributes")
    for name in named:
        if name not in phases:
            raise reader.refuse(element, f"phases {name}: no such phase", suggestion(name, phases))
    for name in (*plus, *minus):
        if bound is None:
            raise reader.refuse(
                element, f"{name}, but the SSD declares no bound", "add the annotation org.perilune.bound"
            )
        if name not in bound.names:
            raise reader.refuse(element, f"{name}: no such bound", suggestion(name, bound.names))
    return BudgetItem(attributes["name"], named, plus, minus)
