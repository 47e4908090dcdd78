"""Linearisation: the linear model over one hyperperiod with respect to the complete memory of a system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy.linalg

from .bench import OperatingPoint
from .jacobian import STEPS, Jacobian, plateau
from .lifted import LiftedModel, StateVariable, reachable
from .modes import CoupledMemory, find_coupled_cells, multipliers

# Error of derivatives from one step of 1e-5: an integrator's multiplier over 5 s is wrong by 2.4e-5 (landing_mission).
ONE_STEP_CHANGE = 1e-5


@dataclass
class Linearisation:
    """Linear model with the data needed to judge it.

    - ``neighbour``: model from the next smaller steps of the differences; the steps are suitable as far as both agree.
    - ``drift``: name, value, change over the period and unit of the model's memory, the largest relative change first.
    - ``blocks``: coupled memory of the whole system, with its multipliers.
    - ``cells``: numbers of the memory cells that are relevant for either model; ``states`` is the number of all cells.
    - ``unknown``: relative change with the steps that is assumed if there was only one step.
    """

    model: LiftedModel
    neighbour: LiftedModel
    drift: list[tuple[str, float, float, str | None]]
    blocks: tuple[CoupledMemory, ...]
    cells: list[int]
    states: int
    unknown: float = 0.0


def linearise(
    operating_point: OperatingPoint, cells: Sequence[int] | None = None, steps: Sequence[float] = STEPS
) -> Linearisation:
    """Return the linear model about the simulation of one hyperperiod.

    ``cells`` are the numbers of the relevant memory cells, if known already. A single step does not show a plateau.
    Raises StudyError if a simulation fails.
    """
    jacobian = Jacobian(operating_point)
    count = len(operating_point.memory.cells)
    driven = [
        plateau(partial(jacobian.input_column, port, sample), steps)
        for port in jacobian.ports
        for sample in range(port.count)
    ]
    screened = None
    if cells is None:
        screened = np.column_stack([jacobian.screen(cell) for cell in range(count)])
        lasting = {int(cell) for block in find_coupled_cells(screened[:count]) for cell in block}
        cells = sorted(lasting.union(np.flatnonzero(_in_between(screened, driven)).tolist()))
    remembered = [plateau(partial(jacobian.cell_column, cell), steps) for cell in cells]
    matrices, models = [], []
    for index in range(2):
        matrix = np.zeros((count + 2 * len(driven), count))
        for cell, column in zip(cells, remembered, strict=True):
            matrix[:, cell] = column[index]
        matrices.append(matrix)
        # the first matrix determines the cells, so that both models have the same
        inside = np.flatnonzero(_in_between(matrices[0], driven))
        models.append(_model(jacobian, inside, matrix, np.column_stack([column[index] for column in driven])))
    change = jacobian.end - jacobian.start
    order = sorted(inside, key=lambda cell: -abs(change[cell]) / jacobian.scale[cell])
    memory = operating_point.memory.cells
    drift = [(memory[cell].name, float(jacobian.start[cell]), float(change[cell]), memory[cell].unit) for cell in order]
    blocks = _blocks(jacobian, matrices[0] if screened is None else screened, driven, matrices)
    unknown = ONE_STEP_CHANGE if len(steps) == 1 else 0.0
    return Linearisation(models[0], models[1], drift, blocks, list(cells), count, unknown)


def _model(jacobian: Jacobian, cells: np.ndarray, matrix: np.ndarray, driven: np.ndarray) -> LiftedModel:
    count, inputs = len(jacobian.memory.cells), driven.shape[1]
    u, v = slice(count, count + inputs), slice(count + inputs, None)
    # Balanced, since the present value of a memory cell says little about its change by a signal.
    a, (balance, _) = scipy.linalg.matrix_balance(matrix[np.ix_(cells, cells)], permute=False, separate=True)
    return LiftedModel(
        a=a,
        b=driven[cells] / balance[:, None],
        cu=matrix[u, cells] * balance,
        du=driven[u],
        cv=matrix[v, cells] * balance,
        dv=driven[v],
        names=tuple(jacobian.memory.cells[cell].name for cell in cells),
        period=jacobian.bench.seconds,
        ports=jacobian.ports,
        variables={
            jacobian.memory.cells[cell].name: StateVariable(
                float(jacobian.scale[cell] * size), jacobian.memory.cells[cell].unit
            )
            for cell, size in zip(cells, balance, strict=True)
        },
    )


def _in_between(columns: np.ndarray, driven: list) -> np.ndarray:
    """Return True for each cell that an excitation affects and that affects an output."""
    count = columns.shape[1]
    moved = _perturb(columns, driven)
    return moved & _moves(columns, np.any(columns[count:] != 0.0, axis=0))


def _perturb(columns: np.ndarray, driven: list) -> np.ndarray:
    count = columns.shape[1]
    return reachable(columns[:count] != 0.0, np.any([column[:count] != 0.0 for column, _ in driven], axis=0))


def _moves(columns: np.ndarray, heard: np.ndarray) -> np.ndarray:
    return reachable((columns[: columns.shape[1]] != 0.0).T, heard)


def _blocks(
    jacobian: Jacobian, arrows: np.ndarray, driven: list, matrices: Sequence[np.ndarray]
) -> tuple[CoupledMemory, ...]:
    """Return the multipliers of all memory, with the cells that each cut affects and depends on along ``arrows``."""
    count, inputs = arrows.shape[1], len(driven)
    moved, moves = [], []
    for port in jacobian.ports:
        signals = np.arange(count + port.first, count + port.first + port.count)
        moved.append(_perturb(arrows, driven[port.rows]))
        moves.append(_moves(arrows, np.any(arrows[np.concatenate([signals, signals + inputs])] != 0.0, axis=0)))
    blocks = []
    for cells in find_coupled_cells(matrices[0][:count]):
        values, neighbours = (multipliers(matrix, cells) for matrix in matrices)
        blocks.append(
            CoupledMemory(
                names=tuple(jacobian.memory.cells[cell].name for cell in cells),
                multipliers=values,
                change=float(abs(abs(values[0]) - abs(neighbours[0]))),
                moved=tuple(bool(np.any(cell[cells])) for cell in moved),
                moves=tuple(bool(np.any(cell[cells])) for cell in moves),
            )
        )
    return tuple(blocks)
