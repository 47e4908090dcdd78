"""Route A: the linear model over one hyperperiod from the complete memory of a system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy.linalg

from ..bench.operating_point import OperatingPoint
from .jacobian import STEPS, Jacobian, plateau
from .lifted import LiftedModel, reached


@dataclass
class Linearisation:
    """A linear model with what is needed to judge it.

    ``neighbour`` is the model from the next smaller steps of the differences: as far as both agree, the steps are
    right. ``drift`` lists name, value, change over the period and unit of the memory in the model, the largest relative
    change first. ``cells`` numbers the model's memory among the ``states`` cells of all.
    """

    model: LiftedModel
    neighbour: LiftedModel
    drift: list[tuple[str, float, float, str | None]]
    cells: list[int]
    states: int


def linearise(
    operating_point: OperatingPoint, cells: Sequence[int] | None = None, steps: Sequence[float] = STEPS
) -> Linearisation:
    """The linear model about the flight of one hyperperiod.

    ``cells`` names the memory that matters if it is known already; of one single step nothing is known of a plateau.
    Raises StudyError where a flight breaks off.
    """
    jacobian = Jacobian(operating_point)
    count = len(operating_point.memory.cells)
    driven = [
        plateau(partial(jacobian.input_column, port, sample), steps)
        for port in jacobian.ports
        for sample in range(port.count)
    ]
    if cells is None:
        cells = _in_between(np.column_stack([jacobian.screened(cell) for cell in range(count)]), driven)
    remembered = [plateau(partial(jacobian.cell_column, cell), steps) for cell in cells]
    models = []
    for place in range(2):
        parts = [column[place] for column in remembered]
        matrix = np.column_stack(parts) if parts else np.zeros((driven[0][0].size, 0))
        models.append(_model(jacobian, list(cells), matrix, np.column_stack([column[place] for column in driven])))
    change = jacobian.end - jacobian.start
    order = sorted(cells, key=lambda cell: -abs(change[cell]) / jacobian.scale[cell])
    memory = operating_point.memory.cells
    drift = [(memory[cell].name, float(jacobian.start[cell]), float(change[cell]), memory[cell].unit) for cell in order]
    return Linearisation(models[0], models[1], drift, list(cells), count)


def _model(jacobian: Jacobian, cells: list[int], matrix: np.ndarray, driven: np.ndarray) -> LiftedModel:
    count, inputs = len(jacobian.memory.cells), driven.shape[1]
    u, v = slice(count, count + inputs), slice(count + inputs, None)
    # Balanced: what the memory happens to hold tells little about how much of it a signal moves.
    a, (balance, _) = scipy.linalg.matrix_balance(matrix[cells], permute=False, separate=True)
    return LiftedModel(
        a=a,
        b=driven[cells] / balance[:, None],
        cu=matrix[u] * balance,
        du=driven[u],
        cv=matrix[v] * balance,
        dv=driven[v],
        names=tuple(jacobian.memory.cells[cell].name for cell in cells),
        period=jacobian.bench.seconds,
        ports=jacobian.ports,
    )


def _in_between(columns: np.ndarray, driven: list) -> list[int]:
    """Cells that what is added moves, and that move what is read."""
    count = columns.shape[1]
    arrows = columns[:count] != 0.0
    moved = reached(arrows, np.any([column[:count] != 0.0 for column, _ in driven], axis=0))
    moves = reached(arrows.T, np.any(columns[count:] != 0.0, axis=0))
    return [int(cell) for cell in np.flatnonzero(moved & moves)]
