"""Read the figures that a system declares: the `org.perilune.report` annotation of its SSD."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from lxml import etree

from ...runtime.ssp.documents import tag
from ...runtime.system.prepared import PreparedSystem
from .declared import Figure, Unavailable
from .history_readers import read_band, read_curve, read_error, read_path, read_pulses
from .scene.reader import read_scene
from .signal_reader import MissingSignalError, SignalReader
from .stage_readers import read_budget, read_limits, read_phases

ANNOTATION = "org.perilune.report"
BUDGET, LIMITS = "Budget", "Limits"
READERS: Mapping[str, Callable[[SignalReader, etree._Element], Figure]] = {
    "Band": read_band,
    "Pulses": read_pulses,
    "Error": read_error,
    "Curve": read_curve,
    "Path": read_path,
    "Phases": read_phases,
    "Scene": read_scene,
    LIMITS: read_limits,
}


def read_figures(prepared: PreparedSystem) -> list[Figure]:
    """The figures of the SSD in their order. Raises InputError with the line.

    Where an FMU substituted by ``use`` lacks a signal, its figure is `Unavailable`, or leaves an optional signal out.
    """
    annotation = prepared.network.description.annotations.get(ANNOTATION)
    if annotation is None:
        return []
    reader = SignalReader(prepared)
    report = reader.content(annotation, "Report")
    reader.parts(report, (*READERS, BUDGET))
    figures: list[Figure] = []
    for element in report.iterchildren(etree.Element):
        reader.notes = []
        name = tag(element)
        try:
            figures.append(read_budget(reader, element, figures) if name == BUDGET else READERS[name](reader, element))
        except MissingSignalError as error:
            figures.append(Unavailable(reader.title(element, name), (str(error),), name == LIMITS))
    return figures
