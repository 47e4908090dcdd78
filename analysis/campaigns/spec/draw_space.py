"""The space that a campaign draws from: its draws as independent standard normal variables, and as a box.

A uniform draw is low + (high - low) Phi(u), a normal one mean + sigma u, jointly normal ones mean + V sqrt(D) u with
the eigenvalues D and eigenvectors V of their covariance: the isoprobabilistic transformation (Hohenbichler and Rackwitz
1981), in closed form for what a campaign can draw.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr, ndtri

from ...common.errors import InputError, suggestion
from ..draws.declared import Columns, Draw
from .campaign import Campaign

INTERVALS = ("uniform", "latin_hypercube", "sobol")  # of which the last two are uniform, with a design
FLAT = 1e-12  # of the largest eigenvalue of a covariance, below which nothing varies


@dataclass(frozen=True)
class _Interval:
    """A value uniform between two ends."""

    names: tuple[str]
    low: float
    high: float
    size: int = 1

    def from_normals(self, u: np.ndarray) -> Columns:
        width = self.high - self.low
        # from the nearer end, so that neither tail is rounded away
        values = np.where(u < 0.0, self.low + width * ndtr(u), self.high - width * ndtr(-u))
        return {self.names[0]: values[:, 0]}

    def to_normals(self, columns: Mapping[str, np.ndarray]) -> np.ndarray:
        values, width = columns[self.names[0]][:, np.newaxis], self.high - self.low
        low, high = (values - self.low) / width, (self.high - values) / width
        with np.errstate(invalid="ignore"):
            return np.where(low < high, ndtri(low), -ndtri(high))

    def from_box(self, places: np.ndarray, sigmas: float) -> Columns:
        return {self.names[0]: self.low + (self.high - self.low) * places[:, 0]}

    def ranges(self, sigmas: float) -> dict[str, tuple[float, float]]:
        return {self.names[0]: (self.low, self.high)}

    def to_box(self, columns: Mapping[str, np.ndarray], sigmas: float) -> np.ndarray:
        return ((columns[self.names[0]] - self.low) / (self.high - self.low))[:, np.newaxis]


@dataclass(frozen=True, eq=False)
class _Normals:
    """Jointly normal values: ``mean`` (names,) and ``factor`` (names, size) of the covariance factor factor^T."""

    names: tuple[str, ...]
    mean: np.ndarray
    factor: np.ndarray

    @property
    def size(self) -> int:
        return self.factor.shape[1]

    def from_normals(self, u: np.ndarray) -> Columns:
        # summed column by column: a matrix product may round a row differently in a longer table
        return {
            name: self.mean[i] + sum(self.factor[i, j] * u[:, j] for j in range(self.size))
            for i, name in enumerate(self.names)
        }

    def to_normals(self, columns: Mapping[str, np.ndarray]) -> np.ndarray:
        offset = np.column_stack([columns[name] for name in self.names]) - self.mean
        return np.linalg.lstsq(self.factor, offset.T, rcond=None)[0].T

    def from_box(self, places: np.ndarray, sigmas: float) -> Columns:
        return self.from_normals(sigmas * (2.0 * places - 1.0))

    def ranges(self, sigmas: float) -> dict[str, tuple[float, float]]:
        half = sigmas * np.sum(np.abs(self.factor), axis=1)
        return {
            name: (float(mean - width), float(mean + width))
            for name, mean, width in zip(self.names, self.mean, half, strict=True)
        }

    def to_box(self, columns: Mapping[str, np.ndarray], sigmas: float) -> np.ndarray:
        return 0.5 + 0.5 * self.to_normals(columns) / sigmas


_Part = _Interval | _Normals


class DrawSpace:
    """A campaign's draws as points of a space: the random ones span it, the ``held`` ones have one value everywhere.

    Choices and grids have no such coordinates and must be held. Latin hypercubes and Sobol sequences are taken for the
    uniform draws that they are designs of. Raises InputError for what is not held and must be, for a held value that
    is not drawn or cannot be, and where nothing varies, unless ``may_be_empty``.

    ``size`` is the number of coordinates, in the order of the file; jointly normal values have as many as their
    covariance has eigenvalues above 0, along its axes.
    """

    def __init__(
        self, campaign: Campaign, held: Mapping[str, float] | None = None, *, may_be_empty: bool = False
    ) -> None:
        self.campaign = campaign
        self.held = dict(held or {})
        names = [name for draw in campaign.draws for name in draw.names]
        for name in self.held:
            if name not in names:
                raise InputError("`hold`", name, f"{campaign.file} does not draw it", suggestion(name, names))
        found = [self._part(draw) for draw in campaign.draws]
        self._parts = [part for part in found if part is not None]
        self.size = sum(part.size for part in self._parts)
        if not may_be_empty:
            self.check_varies()

    def check_varies(self) -> None:
        """Refuse a space in which no draw varies. Raises InputError."""
        if not self.size:
            raise InputError(self.campaign.file, "draw", "no draw varies", "declare a [draw.NAME], or hold fewer")

    @property
    def independent(self) -> bool:
        """Whether each coordinate is a draw by itself."""
        return all(len(part.names) == 1 for part in self._parts)

    @property
    def names(self) -> list[str]:
        """The draws that vary."""
        return [name for part in self._parts for name in part.names]

    def from_normals(self, u: np.ndarray) -> Columns:
        """Draws (a column by name) of independent standard normal values ``u`` (points, size)."""
        return self._whole(len(u), [part.from_normals(block) for part, block in self._blocks(u)])

    def to_normals(self, columns: Mapping[str, np.ndarray]) -> np.ndarray:
        """The inverse of `from_normals`; infinite at an interval's ends."""
        return np.column_stack([part.to_normals(columns) for part in self._parts])

    def from_box(self, places: np.ndarray, sigmas: float) -> Columns:
        """Draws at ``places`` (points, size) in the unit cube, which spans intervals and normals within ``sigmas``.

        For jointly normal values these are standard deviations along the axes of their covariance.
        """
        return self._whole(len(places), [part.from_box(block, sigmas) for part, block in self._blocks(places)])

    def to_box(self, columns: Mapping[str, np.ndarray], sigmas: float) -> np.ndarray:
        """The inverse of `from_box`; draws outside the box have places below 0 or above 1."""
        return np.column_stack([part.to_box(columns, sigmas) for part in self._parts])

    def ranges(self, sigmas: float) -> dict[str, tuple[float, float]]:
        """The least and the largest value of each draw that varies in the box of `from_box`.

        Jointly normal values reach them one at a time: the box is along the axes of their covariance.
        """
        found: dict[str, tuple[float, float]] = {}
        for part in self._parts:
            found |= part.ranges(sigmas)
        return found

    def _blocks(self, points: np.ndarray) -> list[tuple[_Part, np.ndarray]]:
        ends = np.cumsum([part.size for part in self._parts])
        return list(zip(self._parts, np.split(points, ends, axis=1)[:-1], strict=True))

    def _whole(self, points: int, parts: list[Columns]) -> Columns:
        """The columns of all draws, the held ones too, in the order of the file."""
        found = {name: np.full(points, value) for name, value in self.held.items()}
        for part in parts:
            found |= part
        return {name: np.ascontiguousarray(found[name]) for draw in self.campaign.draws for name in draw.names}

    def _part(self, draw: Draw) -> _Part | None:
        """The coordinates of a draw; None where it is held."""
        where, arguments = (self.campaign.file, f"draw.{draw.name}"), draw.arguments
        given = [name for name in draw.names if name in self.held]
        if given:
            if len(given) < len(draw.names):
                lacking = ", ".join(name for name in draw.names if name not in given)
                raise InputError("`hold`", given[0], f"is drawn together with {lacking}", "hold all of them or none")
            if "values" in arguments and self.held[draw.name] not in arguments["values"]:
                known = ", ".join(f"{value:g}" for value in arguments["values"])
                raise InputError("`hold`", draw.name, f"{self.held[draw.name]:g} is none of its values", f"use {known}")
            return None
        if draw.distribution in INTERVALS:
            return _Interval((draw.name,), arguments["low"], arguments["high"])
        if draw.distribution == "normal":
            return _Normals(draw.names, np.array([arguments["mean"]]), np.array([[arguments["sigma"]]]))
        if draw.distribution == "correlated_normal":
            values, vectors = np.linalg.eigh(np.array(arguments["covariance"]))
            kept = values > FLAT * values[-1]
            return _Normals(draw.names, np.array(arguments["mean"]), vectors[:, kept] * np.sqrt(values[kept]))
        problem = f"a {draw.distribution} has single values, and this study goes between them"
        raise InputError(*where, problem, f"hold it: `hold` {draw.name}={arguments['values'][0]:g}, or another value")
