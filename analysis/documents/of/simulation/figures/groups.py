"""Figures declared in a system's SSD, each below its heading, in the declared groups."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .....runtime.flight.results import FlightResult
from ....cell import Inline, Rich
from ....figures.declared import (
    BandFigure,
    BudgetFigure,
    CurveFigure,
    ErrorFigure,
    FigureDeclaration,
    GroupDeclaration,
    LimitsFigure,
    PathFigure,
    PhasesFigure,
    PulsesFigure,
    UnavailableFigure,
)
from ....figures.scene.scene_elements import SceneFigure
from ....model import Group, Table
from .band_figure import band_section, inside, settling_text
from .figure_texts import condition_text
from .history_figures import curve_section, error_section
from .limits import LimitVerdict, evaluate, limit_rows
from .path_figure import path_section
from .phase_figure import budget_section, phase_section
from .pulse_figure import pulse_section
from .section import figure_group


class FigureGroup(NamedTuple):
    """Figures under a common heading, folded on a page if ``is_folded``."""

    title: str
    is_folded: bool
    figures: list[Group]


def figure_groups(
    figures: Sequence[FigureDeclaration], result: FlightResult, system: str
) -> tuple[list[Group], list[FigureGroup]]:
    """Return the tables of limits, which a header summarises, and other figures by group.

    Figures without a group are under the ``system``'s name.
    """
    limits: list[Group] = []
    by_group: dict[GroupDeclaration, list[Group]] = {}
    for figure, subsection in _subsections(figures, result, is_counted=False):
        judges = isinstance(figure, LimitsFigure) or (isinstance(figure, UnavailableFigure) and figure.has_limits)
        members = (
            limits if judges else by_group.setdefault(figure.group or GroupDeclaration(system, is_folded=False), [])
        )
        members.append(subsection)
    return limits, [FigureGroup(group.title, group.is_folded, members) for group, members in by_group.items()]


def figure_sections(figures: Sequence[FigureDeclaration], result: FlightResult) -> list[Group]:
    """Return a section for each figure except scenes, in the order of the SSD; none for a run without samples."""
    return [subsection for _, subsection in _subsections(figures, result, is_counted=True)]


def _subsections(
    figures: Sequence[FigureDeclaration], result: FlightResult, *, is_counted: bool
) -> list[tuple[FigureDeclaration, Group]]:
    if not result.time.size:
        return []
    plotted = [figure for figure in figures if not isinstance(figure, SceneFigure)]
    return [(figure, _subsection(figure, result, f"figure{index}", is_counted)) for index, figure in enumerate(plotted)]


def _subsection(figure: FigureDeclaration, result: FlightResult, name: str, is_counted: bool) -> Group:
    if (
        isinstance(figure, ErrorFigure | CurveFigure | PathFigure)
        and figure.rows is not None
        and not figure.rows.select(result).any()
    ):
        return figure_group(figure.title, notes=[["Not plotted: no sample where ", *condition_text(figure.rows), "."]])
    match figure:
        case BandFigure():
            return band_section(figure, result, name)
        case PulsesFigure():
            return pulse_section(figure, result, name)
        case ErrorFigure():
            return error_section(figure, result, name)
        case CurveFigure():
            return curve_section(figure, result, name)
        case PathFigure():
            return path_section(figure, result, name)
        case PhasesFigure():
            return phase_section(figure, result, name)
        case LimitsFigure():
            return limit_section(figure, result, is_counted)
        case BudgetFigure():
            return budget_section(figure, result)
    return figure_group(figure.title, notes=[f"Not plotted: {note}." for note in figure.notes])


def joint_findings(figures: Sequence[FigureDeclaration], result: FlightResult) -> list[Rich]:
    """Return, for each name that several bands share, a statement of the time from which all of them hold."""
    conditions: dict[str, list[np.ndarray]] = {}
    for band in figures:
        if isinstance(band, BandFigure) and result.time.size:
            conditions.setdefault(band.name, []).append(np.logical_and.reduce(inside(band, result)))
    findings: list[Rich] = []
    for name, bands in conditions.items():
        if len(bands) > 1:
            count = "both bands" if len(bands) == 2 else f"all {len(bands)} bands"
            text: list[Inline] = [f"{count}: ", *settling_text(name, result.time, np.logical_and.reduce(bands))]
            findings.append(text)
    return findings


def limit_section(limits: LimitsFigure, result: FlightResult, is_counted: bool) -> Group:
    """Return the section of limits: their table, or why none is evaluated; ``is_counted`` adds a summary."""
    violated = [limit.name for limit, verdict in evaluate(limits, result) if verdict is LimitVerdict.VIOLATED]
    obstacle = limits.obstacle(result)
    total = len(limits.limits)
    verdicts = f"{total - len(violated)} of {total} limits met"
    if violated:
        verdicts += f"; violated: {', '.join(violated)}"
    return figure_group(
        limits.title,
        table=Table(("", "final value", "limit", "unit", ""), limit_rows(limits, result), style=""),
        findings=[f"not evaluated: {obstacle}"] if obstacle else [verdicts] if is_counted else [],
        notes=limits.notes,
    )
