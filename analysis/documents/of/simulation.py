"""The figures of a simulation in documents: those of its system, trajectories, signals over time."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from ...reports.figures.declared import Figure
from ...reports.figures.figure_sections import figure_sections, joint_findings
from ...reports.figures.section import Section
from ...reports.time_histories import time_histories
from ...reports.trajectory import trajectory_legend, trajectory_panels, trajectory_reading
from ...runtime.flight.results import Result
from ..model import Fold, History, Node, SystemFigures


def simulation_nodes(simulation: Result, figures: Sequence[Figure]) -> list[Node]:
    """Return the ``figures`` that the system declares, trajectories, states and commands, and other signals folded."""
    views = trajectory_panels(simulation)
    trajectory = Section(
        title="Trajectory",
        panels=views,
        legend=trajectory_legend(simulation),
        notes=[Markup("{}").format(trajectory_reading(simulation))],
    )
    sections = [*figure_sections(figures, simulation), *([trajectory] if views else [])]
    histories = time_histories(simulation)
    others = f"Other signals: {histories.folded} plots, constant and duplicate signals"
    return [
        SystemFigures(sections, joint_findings(figures, simulation)),
        *map(History, histories.first),
        *([Fold(others, [History(each) for each in histories.rest])] if histories.rest else []),
    ]
