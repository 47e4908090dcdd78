"""Reader of the figures that a system declares in the `org.perilune.report` annotation of its SSD."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from lxml import etree

from ...runtime.ssp.documents import tag
from ...runtime.system.prepared import PreparedSystem
from .declared import FigureDeclaration, GroupDeclaration, UnavailableFigure
from .history_readers import read_band, read_curve, read_error, read_path, read_pulses
from .scene.reader import read_scene
from .signal_reader import MissingSignalError, SignalReader
from .stage_readers import read_budget, read_limits, read_phases

ANNOTATION = "org.perilune.report"
BUDGET, LIMITS = "Budget", "Limits"
GROUP, FOLDED = "Group", "folded"
UNGROUPED = (LIMITS, "Scene")  # elements with separate sections
READERS: Mapping[str, Callable[[SignalReader, etree._Element], FigureDeclaration]] = {
    "Band": read_band,
    "Pulses": read_pulses,
    "Error": read_error,
    "Curve": read_curve,
    "Path": read_path,
    "Phases": read_phases,
    "Scene": read_scene,
    LIMITS: read_limits,
}


def read_figures(prepared: PreparedSystem) -> list[FigureDeclaration]:
    """Read the figures of the SSD in their order. Raises InputError with the line.

    If an FMU substituted by ``use`` lacks a signal, its figure becomes an `UnavailableFigure`, or omits an optional
    signal.
    """
    annotation = prepared.network.description.annotations.get(ANNOTATION)
    if annotation is None:
        return []
    reader = SignalReader(prepared)
    figures: list[FigureDeclaration] = []
    for element, group in _elements(reader, reader.content(annotation, "Report")):
        reader.notes = []
        name = tag(element)
        try:
            figure = read_budget(reader, element, figures) if name == BUDGET else READERS[name](reader, element)
        except MissingSignalError as error:
            figure = UnavailableFigure(reader.title(element, name), (str(error),), name == LIMITS)
        figures.append(replace(figure, group=group))
    return figures


def _elements(reader: SignalReader, report: etree._Element) -> Iterator[tuple[etree._Element, GroupDeclaration | None]]:
    """Yield the elements of figures in order, each with its group."""
    reader.parts(report, (*READERS, BUDGET, GROUP))
    for element in report.iterchildren(etree.Element):
        if tag(element) != GROUP:
            yield element, None
            continue
        group = GroupDeclaration(
            reader.attributes(element, ("title",), (FOLDED,))["title"], reader.truth(element, FOLDED)
        )
        if not any(reader.parts(element, [name for name in (*READERS, BUDGET) if name not in UNGROUPED]).values()):
            raise reader.refuse(element, "has no figure", "add a figure, or remove this element")
        yield from ((figure, group) for figure in element.iterchildren(etree.Element))
