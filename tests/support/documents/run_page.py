"""Page of a run, written from its result."""

from collections.abc import Sequence
from pathlib import Path

from perilune.analysis.documents.diagram.diagram import BlockDiagram
from perilune.analysis.documents.figures.declared import FigureDeclaration
from perilune.analysis.documents.of.simulation.run import RunContext, run_document
from perilune.analysis.documents.render.html import write_document
from perilune.analysis.runtime.flight.results import FlightResult


def write_run_report(
    result: FlightResult,
    path: Path,
    title: str,
    figures: Sequence[FigureDeclaration] = (),
    diagram: BlockDiagram | None = None,
    command: str = "",
) -> None:
    """Write the page of a run that has no system behind it."""
    draw = None if diagram is None else lambda: diagram
    write_document(
        run_document(result, RunContext(title=title, figures=figures, draw_diagram=draw, command=command)), path
    )
