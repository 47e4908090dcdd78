"""The main figure of each study, as a notebook shows it."""

from __future__ import annotations

from matplotlib.figure import Figure

from ...studies.rare.outcome import RareResult
from ...studies.sensitivity import SensitivityResult
from ...studies.worst.outcome import WorstResult
from ..common.style import WIDTH, house_style, new_figure
from .rare_figures import draw_design_points, draw_exceedance, draw_limit_state, influence
from .sensitivity_page import LANE, MOST, bars_of, draw_indices
from .worst_figures import draw_search, draw_trials

HEIGHT = 3.2  # in
COLUMNS = 2


def rare_plot(result: RareResult) -> Figure:
    """Limit state over simulations, exceedance probability; failures over the two most influential parameters."""
    names = list(influence(result))[:2]
    with house_style():
        figure = new_figure(2.0 * HEIGHT, WIDTH)
        grid = figure.add_gridspec(2, 2)
        draw_limit_state(figure.add_subplot(grid[0, :]), result)
        if len(names) == 2:
            draw_exceedance(figure.add_subplot(grid[1, 0]), result)
            draw_design_points(figure.add_subplot(grid[1, 1]), result, *names)
        else:
            draw_exceedance(figure.add_subplot(grid[1, :]), result)
    return figure


def worst_plot(result: WorstResult) -> Figure:
    """The search over simulations, and the random trials with the worst case."""
    with house_style():
        figure = new_figure(HEIGHT, WIDTH)
        left, right = figure.subplots(1, 2, width_ratios=(1.4, 1.0))
        draw_search(left, result)
        draw_trials(right, result)
    return figure


def sensitivity_plot(result: SensitivityResult, metrics: list[str]) -> Figure:
    """A panel of indices for each metric."""
    columns = min(COLUMNS, len(metrics))
    rows = -(-len(metrics) // columns)
    lanes = min(MOST, len(result.inputs))
    with house_style():
        figure = new_figure(rows * (1.1 + LANE * lanes), 0.5 * WIDTH * columns)
        panels = figure.subplots(rows, columns, squeeze=False).flatten()
        for axes, metric in zip(panels, metrics, strict=False):
            draw_indices(axes, bars_of(result, metric)[:MOST])
            axes.set_title(metric, loc="left")
        for axes in panels[len(metrics) :]:
            axes.remove()
    return figure
