"""Conversion of a plant's matrices to real two-dimensional arrays, with checks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ....common.errors import InputError


def state_matrix(value: ArrayLike) -> np.ndarray:
    """Return A (n, n). Raises InputError."""
    matrix = real_matrix("A", value)
    if matrix.shape[0] != matrix.shape[1] or not matrix.size:
        raise InputError("modal", "A", f"is {_size(matrix)}", "give a square matrix, n by n")
    return matrix


def input_matrix(value: ArrayLike, states: int) -> np.ndarray:
    """Return B (n, m). Raises InputError."""
    matrix = real_matrix("B", value)
    if matrix.shape[0] != states or not matrix.size:
        raise InputError("modal", "B", f"is {_size(matrix)}, but A has {states} states", "give one row per state")
    return matrix


def output_matrix(value: ArrayLike, states: int) -> np.ndarray:
    """Return C (p, n). Raises InputError."""
    matrix = real_matrix("C", value)
    if matrix.shape[1] != states or not matrix.size:
        raise InputError("modal", "C", f"is {_size(matrix)}, but A has {states} states", "give one column per state")
    return matrix


def real_matrix(name: str, value: ArrayLike | Sequence[ArrayLike], shape: tuple[int, ...] | None = None) -> np.ndarray:
    """Return a real, finite array with this ``shape``, or any two-dimensional one. Raises InputError."""
    try:
        matrix = np.asarray(value)
    except ValueError:  # rows of different lengths
        raise InputError("modal", name, "has rows of different lengths", "give rows of equal length") from None
    if matrix.dtype.kind not in "biuf":
        raise InputError("modal", name, f"has elements of type {matrix.dtype}", "give real numbers")
    if shape is None and matrix.ndim != 2:
        raise InputError("modal", name, f"has {matrix.ndim} dimensions", "give a matrix, a list of rows")
    if shape is not None and matrix.shape != shape:
        raise InputError("modal", name, f"is {_size(matrix)}", f"give {' by '.join(map(str, shape))} numbers")
    if not np.all(np.isfinite(matrix)):
        raise InputError("modal", name, "has an element that is not finite", "give finite numbers")
    return matrix.astype(float)


def _size(matrix: np.ndarray) -> str:
    return " by ".join(map(str, matrix.shape)) or "a number"
