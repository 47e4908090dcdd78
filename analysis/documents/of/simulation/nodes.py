"""Figures of a simulation for other documents: declared figures, trajectories, signals over time."""

from __future__ import annotations

from collections.abc import Sequence

from ....runtime.flight.results import FlightResult
from ...figures.declared import FigureDeclaration
from ...model import Fold, Group, Node, Note, Text
from ...pictures import Figures
from .figures.groups import figure_sections, joint_findings
from .histories import time_histories
from .trajectory import trajectory_figures, trajectory_legend, trajectory_reading


def simulation_nodes(simulation: FlightResult, figures: Sequence[FigureDeclaration]) -> list[Node]:
    """Return the declared ``figures``, trajectories, states and commands, and other signals folded."""
    histories = time_histories(simulation)
    others = f"Other signals: {histories.folded} plots, constant and duplicate signals"
    trajectory = trajectory_nodes(simulation)
    return [
        *map(Text, joint_findings(figures, simulation)),
        *figure_sections(figures, simulation),
        *([Group("Trajectory", trajectory)] if trajectory else []),
        *(history.subsection() for history in histories.first),
        *([Fold(others, [history.subsection() for history in histories.rest])] if histories.rest else []),
    ]


def trajectory_nodes(simulation: FlightResult) -> list[Node]:
    """Return the views of trajectories with their caption; none if there is no position."""
    views = trajectory_figures(simulation)
    if not views:
        return []
    return [
        Figures(lambda: views, trajectory_legend(simulation), is_in_order=True),
        Note(trajectory_reading(simulation)),
    ]
