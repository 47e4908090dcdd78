"""Readers of figures of signals over time, or over one another, from elements of the annotation."""

from __future__ import annotations

from dataclasses import replace

from lxml import etree

from ...runtime.ssp.conversions import BASE_UNITS, Unit
from ...runtime.ssp.types import WHOLE
from .declared import Arc, BandFigure, CurveFigure, ErrorFigure, PathFigure, PathPoint, PulsesFigure
from .signal_reader import ROWS, SignalReader

SECOND, METRE = (Unit(unit, tuple(int(name == unit) for name in BASE_UNITS)) for unit in ("s", "m"))
INSIDE = "within the band"
BAND = ("low", "high", "unit", "about", "less", "shade", "shade_below", "against", "name", "labels", "title")
CURVE = ("low", "high", "unit", "together", "labels", "title", *ROWS)


def read_band(reader: SignalReader, element: etree._Element) -> BandFigure:
    attributes = reader.attributes(element, ("signal",), BAND)
    low, high = reader.limits(element, "low", "high")
    if low is None and high is None:
        raise reader.refuse(element, "has neither low nor high", "give low, high or both")
    unit = reader.unit(element, attributes["unit"], attributes["signal"]) if "unit" in attributes else None
    signal = reader.signal(element, "signal", unit=unit)
    about = tuple(signal.factor * value for value in reader.numbers(element, "about"))
    signal = reader.about(element, signal)
    if ("shade" in attributes) != ("shade_below" in attributes):
        raise reader.refuse(element, "shade and shade_below belong together", "give both, or neither")
    return BandFigure(
        title=reader.title(element, signal.label),
        notes=tuple(reader.notes),
        signal=signal,
        low=low,
        high=high,
        name=attributes.get("name") or INSIDE,
        about=about,
        labels=reader.labels(element, signal),
        less=reader.signal(element, "less", like=signal) if "less" in attributes else None,
        shade=reader.scalar(element, "shade") if "shade" in attributes else None,
        shade_below=reader.number(element, "shade_below") or 0.0,
        against=tuple(reader.find_signal(element, "against", name) for name in attributes.get("against", "").split()),
    )


def read_pulses(reader: SignalReader, element: etree._Element) -> PulsesFigure:
    reader.attributes(element, ("lengths",), ("count", "remainder", "total", "labels", "title"))
    lengths = reader.signal(element, "lengths", unit=SECOND)
    return PulsesFigure(
        count=reader.scalar(element, "count", WHOLE) if "count" in element.attrib else None,
        remainder=reader.optional(element, "remainder", lambda name: reader.signal(element, name, like=lengths)),
        total=reader.optional(element, "total", lambda name: reader.scalar(element, name)),
        lengths=lengths,
        labels=reader.labels(element, lengths),
        title=reader.title(element, lengths.label),
        notes=tuple(reader.notes),
    )


def read_error(reader: SignalReader, element: etree._Element) -> ErrorFigure:
    reader.attributes(element, ("estimate", "truth"), ("sigma", "after", "labels", "title", *ROWS))
    estimate = reader.signal(element, "estimate")
    truth = reader.signal(element, "truth", like=estimate)
    sigma = reader.optional(element, "sigma", lambda name: reader.signal(element, name, like=estimate))
    if sigma is not None:  # a standard deviation is a difference, which has no offset
        sigma = replace(sigma, offsets=(0.0,) * len(sigma.names))
    return ErrorFigure(
        estimate=estimate,
        truth=truth,
        sigma=sigma,
        after=reader.number(element, "after"),
        labels=reader.labels(element, estimate),
        title=reader.title(element, f"{estimate.label} less {truth.label}"),
        notes=tuple(reader.notes),
        rows=reader.rows(element),
    )


def read_curve(reader: SignalReader, element: etree._Element) -> CurveFigure:
    attributes = reader.attributes(element, ("signals",), CURVE)
    names = attributes["signals"].split()
    first = reader.find_signal(element, "signals", names[0])
    unit = reader.unit(element, attributes["unit"], names[0]) if "unit" in attributes else first.unit
    signals = [
        reader.convert_limits(element, f"signals {name}", reader.find_signal(element, "signals", name), unit)
        for name in names
    ]
    labels = tuple(element.get("labels", "").split())
    if labels and len(labels) != len(signals):
        raise reader.refuse(
            element, f"labels has {len(labels)} names, but signals has {len(signals)}", "give one label for each signal"
        )
    low, high = reader.limits(element, "low", "high")
    return CurveFigure(
        title=reader.title(element, attributes["signals"]),
        signals=tuple(signals),
        labels=labels or tuple(signal.label for signal in signals),
        low=low,
        high=high,
        together=reader.truth(element, "together"),
        rows=reader.rows(element),
        notes=tuple(reader.notes),
    )


def read_path(reader: SignalReader, element: etree._Element) -> PathFigure:
    attributes = reader.attributes(element, ("y",), ("x", "arc", "radius", "equal", "title", *ROWS))
    if ("x" in attributes) == ("arc" in attributes) or ("arc" in attributes) != ("radius" in attributes):
        raise reader.refuse(element, "needs either x, or arc and radius", "give one of the two")
    x = reader.scalar(element, "x") if "x" in attributes else _arc(reader, element)
    y = reader.scalar(element, "y")
    equal = reader.truth(element, "equal")
    if equal and x.unit_name != y.unit_name:
        raise reader.refuse(
            element,
            f"equal needs the same unit on both axes, but {x.label} and {y.label} have different units",
            "leave out equal",
        )
    points = []
    for child in reader.parts(element, ("Point",))["Point"]:
        if isinstance(x, Arc):
            raise reader.refuse(
                child, "a Path with arc cannot have Points", "remove the Point, or give the Path x instead of arc"
            )
        name = reader.attributes(child, ("x", "y", "name"))["name"]
        points.append(PathPoint(reader.scalar(child, "x", like=x), reader.scalar(child, "y", like=y), name))
    return PathFigure(
        title=reader.title(element, f"{y.label} over {x.label}"),
        x=x,
        y=y,
        equal=equal,
        points=tuple(points),
        rows=reader.rows(element),
        notes=tuple(reader.notes),
    )


def _arc(reader: SignalReader, element: etree._Element) -> Arc:
    position = reader.signal(element, "arc", unit=METRE)
    if len(position.names) != 3:
        problem = f"arc {position.label} has {len(position.names)} elements"
        raise reader.signal_error(element, position.label, problem, "name a position")
    radius = reader.parameter(element, "radius")
    if not radius > 0.0:
        raise reader.refuse(element, f"radius {element.get('radius')} is {radius:g}", "name the radius of the ground")
    return Arc(position, radius)
