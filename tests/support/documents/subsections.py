"""Subsections of a run's document as a page shows them: rendered panels, sentences, cells."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from markupsafe import Markup

from perilune.analysis.documents.common.panels import FigurePanel
from perilune.analysis.documents.figures.declared import FigureDeclaration
from perilune.analysis.documents.interactive.charts import Drawing
from perilune.analysis.documents.model import Group, Note, Table, Text
from perilune.analysis.documents.of.simulation import histories, trajectory
from perilune.analysis.documents.of.simulation.figures import groups as figure_groups
from perilune.analysis.documents.pictures import Figures
from perilune.analysis.documents.render.cell_markup import cell_markup, legend_swatch, rich_markup
from perilune.analysis.documents.render.html import panel_of
from perilune.analysis.runtime.flight.results import FlightResult


@dataclass
class ReadTable:
    """Headings and rendered cells."""

    heads: tuple[str, ...]
    rows: list[list[Markup]]


@dataclass
class ReadSubsection:
    """A heading with plots, panels or one as wide as the page, a table, results and captions."""

    title: str
    panels: list[FigurePanel] = field(default_factory=list)
    plot: Drawing | None = None
    legend: list[tuple[Markup, str]] = field(default_factory=list)
    findings: list[Markup] = field(default_factory=list)
    table: ReadTable | None = None
    notes: list[Markup] = field(default_factory=list)


def read_subsection(subsection: Group) -> ReadSubsection:
    """Return a subsection with its nodes rendered."""
    read = ReadSubsection(subsection.heading)
    for node in subsection.nodes:
        match node:
            case Figures(draw, legend):
                read.legend = [(legend_swatch(entry), ", ".join(entry.lines)) for entry in legend]
                for figure in draw():
                    if figure.is_wide:
                        read.plot = panel_of(figure).figure
                    else:
                        read.panels.append(panel_of(figure))
            case Text(content):
                read.findings.append(rich_markup(content, is_sentence=True))
            case Table(heads, rows):
                read.table = ReadTable(tuple(heads), [list(map(cell_markup, row)) for row in rows])
            case Note(content):
                read.notes.append(rich_markup(content))
    return read


def figure_sections(figures: Sequence[FigureDeclaration], result: FlightResult) -> list[ReadSubsection]:
    """Return the figures that a system declares as a page shows them."""
    return [read_subsection(each) for each in figure_groups.figure_sections(figures, result)]


def joint_findings(figures: Sequence[FigureDeclaration], result: FlightResult) -> list[Markup]:
    """Return the sentences on several bands."""
    return [rich_markup(each, is_sentence=True) for each in figure_groups.joint_findings(figures, result)]


def trajectory_panels(result: FlightResult) -> list[FigurePanel]:
    """Return the views of trajectories."""
    return [panel_of(figure) for figure in trajectory.trajectory_figures(result)]


def first_histories(result: FlightResult) -> list[ReadSubsection]:
    """Return the states and commands of each component."""
    return [read_subsection(each.subsection()) for each in histories.time_histories(result).first]
