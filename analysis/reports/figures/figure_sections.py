"""The sections of the figures that a system declares in its SSD."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

from ...runtime.flight.results import Result
from ..common.page import Table
from .band_figure import band_section, inside, settling_text
from .declared import Band, Budget, Curve, Error, Figure, Group, Limits, Path, Phases, Pulses, Unavailable
from .history_figures import curve_section, error_section
from .limits import Verdict, evaluate, limit_rows
from .path_figure import path_section
from .phase_figure import budget_section, phase_section
from .pulse_figure import pulse_section
from .scene.declared import Scene
from .section import Section
from .words import condition_text, sentence


class SectionGroup(NamedTuple):
    """Sections under a common heading, which a page folds where ``is_folded``."""

    title: str
    is_folded: bool
    sections: list[Section]


def figure_groups(figures: Sequence[Figure], result: Result, system: str) -> tuple[list[Section], list[SectionGroup]]:
    """Return the sections of limits, and those of other figures by group, without one under the ``system``'s name."""
    limits: list[Section] = []
    by_group: dict[Group, list[Section]] = {}
    for figure, section in _sections(figures, result):
        judges = isinstance(figure, Limits) or (isinstance(figure, Unavailable) and figure.has_limits)
        members = limits if judges else by_group.setdefault(figure.group or Group(system, is_folded=False), [])
        members.append(section)
    return limits, [SectionGroup(group.title, group.is_folded, members) for group, members in by_group.items()]


def figure_sections(figures: Sequence[Figure], result: Result) -> list[Section]:
    """A section for each figure but a scene, in the order of the SSD; none for a run without samples."""
    return [section for _, section in _sections(figures, result)]


def _sections(figures: Sequence[Figure], result: Result) -> list[tuple[Figure, Section]]:
    if not result.time.size:
        return []
    plotted = [figure for figure in figures if not isinstance(figure, Scene)]
    return [(figure, _section(figure, result, f"figure{index}")) for index, figure in enumerate(plotted)]


def _section(figure: Figure, result: Result, name: str) -> Section:
    if isinstance(figure, Error | Curve | Path) and figure.rows is not None and not figure.rows.select(result).any():
        note = Markup("Not plotted: no sample where {}.").format(condition_text(figure.rows))
        return Section(title=figure.title, notes=[note])
    match figure:
        case Band():
            return band_section(figure, result, name)
        case Pulses():
            return pulse_section(figure, result, name)
        case Error():
            return error_section(figure, result, name)
        case Curve():
            return curve_section(figure, result, name)
        case Path():
            return path_section(figure, result, name)
        case Phases():
            return phase_section(figure, result, name)
        case Limits():
            return limit_section(figure, result)
        case Budget():
            return budget_section(figure, result)
    return Section(title=figure.title, notes=[Markup("Not plotted: {}.").format(note) for note in figure.notes])


def joint_findings(figures: Sequence[Figure], result: Result) -> list[Markup]:
    """The time from which all bands of one name hold, where several have it."""
    conditions: dict[str, list[np.ndarray]] = {}
    for band in figures:
        if isinstance(band, Band) and result.time.size:
            conditions.setdefault(band.name, []).append(np.logical_and.reduce(inside(band, result)))
    findings = []
    for name, bands in conditions.items():
        if len(bands) > 1:
            count = "both bands" if len(bands) == 2 else f"all {len(bands)} bands"
            text = settling_text(name, result.time, np.logical_and.reduce(bands))
            findings.append(sentence(Markup("{}: {}").format(count, text)))
    return findings


def limit_section(limits: Limits, result: Result) -> Section:
    """The table of limits, with how many are met and which are violated, or why none is evaluated."""
    violated = [limit.name for limit, verdict in evaluate(limits, result) if verdict is Verdict.VIOLATED]
    obstacle = limits.obstacle(result)
    total = len(limits.limits)
    verdicts = Markup("{} of {} limits met").format(total - len(violated), total)
    if violated:
        verdicts = Markup("{}; violated: {}").format(verdicts, ", ".join(violated))
    return Section(
        title=limits.title,
        table=Table(
            heads=("", "final value", "limit", "unit", ""),
            rows=limit_rows(limits, result),
            numbers=(1, 2),
        ),
        findings=[sentence(Markup("not evaluated: {}").format(obstacle) if obstacle else verdicts)],
        notes=limits.notes,
    )
