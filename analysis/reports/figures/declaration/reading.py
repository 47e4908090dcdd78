"""The figures that a system asks for, from the `org.perilune.report` annotation of its SSD."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from lxml import etree

from ....runtime.ssp.documents import tag
from ....runtime.system.prepared import PreparedSystem
from .figures import Figure
from .history_readers import read_band, read_curve, read_error, read_path, read_pulses
from .signal_reader import LackingError, SignalReader
from .stage_readers import read_budget, read_limits, read_phases
from .values import Undrawn

ANNOTATION = "org.perilune.report"
BUDGET, LIMITS = "Budget", "Limits"
READERS: Mapping[str, Callable[[SignalReader, etree._Element], Figure]] = {
    "Band": read_band,
    "Pulses": read_pulses,
    "Error": read_error,
    "Curve": read_curve,
    "Path": read_path,
    "Phases": read_phases,
    LIMITS: read_limits,
}


def read_figures(prepared: PreparedSystem) -> list[Figure]:
    """What the SSD asks for, in its order, none where it asks for nothing. Raises InputError naming the line.

    What an FMU lacks that was put in by ``use`` is no fault of the SSD: its figure is an `Undrawn` one, or does
    without.
    """
    annotation = prepared.network.description.annotations.get(ANNOTATION)
    if annotation is None:
        return []
    reader = SignalReader(prepared)
    report = reader.content(annotation, "Report")
    reader.parts(report, (*READERS, BUDGET))
    found: list[Figure] = []
    for element in report.iterchildren(etree.Element):
        reader.notes = []
        name = tag(element)
        try:
            found.append(read_budget(reader, element, found) if name == BUDGET else READERS[name](reader, element))
        except LackingError as lacking:
            found.append(Undrawn(reader.title(element, name), (str(lacking),), name == LIMITS))
    return found
