"""The space that a campaign draws from: its draws as independent standard normal variables, and as a box.

Each distribution gives its own coordinates (``distributions/``).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...common.errors import InputError, suggestion
from ..campaigns.definition.campaign import Campaign
from ..campaigns.definition.distributions import Discrete
from ..campaigns.draws.declared import Columns, Continuous, Draw


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
        self._varied = [pair for pair in map(self._coordinates, campaign.draws) if pair is not None]
        self.size = sum(distribution.size for _, distribution in self._varied)
        if not may_be_empty:
            self.check_varies()

    def check_varies(self) -> None:
        """Refuse a space in which no draw varies. Raises InputError."""
        if not self.size:
            raise InputError(self.campaign.file, "draw", "no draw varies", "declare a [draw.NAME], or hold fewer")

    @property
    def independent(self) -> bool:
        """True if each coordinate is a draw by itself."""
        return all(len(names) == 1 for names, _ in self._varied)

    @property
    def names(self) -> list[str]:
        return [name for names, _ in self._varied for name in names]

    def from_normals(self, u: np.ndarray) -> Columns:
        """Return draws (a column by name) of independent standard normal values ``u`` (points, size)."""
        return self._columns(len(u), [distribution.from_normals(block) for distribution, block in self._blocks(u)])

    def to_normals(self, columns: Mapping[str, np.ndarray]) -> np.ndarray:
        """Return the inverse of `from_normals`; infinite at an interval's ends."""
        return np.column_stack(
            [distribution.to_normals([columns[name] for name in names]) for names, distribution in self._varied]
        )

    def from_box(self, points: np.ndarray, sigmas: float) -> Columns:
        """Return draws at ``points`` (points, size) in the unit cube, which spans intervals and normals within
        ``sigmas``.

        For jointly normal values these are standard deviations along the axes of their covariance.
        """
        blocks = self._blocks(points)
        return self._columns(len(points), [distribution.from_box(block, sigmas) for distribution, block in blocks])

    def to_box(self, columns: Mapping[str, np.ndarray], sigmas: float) -> np.ndarray:
        """Return the inverse of `from_box`; draws outside the box have coordinates below 0 or above 1."""
        return np.column_stack(
            [distribution.to_box([columns[name] for name in names], sigmas) for names, distribution in self._varied]
        )

    def ranges(self, sigmas: float) -> dict[str, tuple[float, float]]:
        """Return minimum and maximum of each draw that varies in the box of `from_box`.

        Jointly normal values reach them one at a time: the box is along the axes of their covariance.
        """
        return {
            name: ends
            for names, distribution in self._varied
            for name, ends in zip(names, distribution.ranges(sigmas), strict=True)
        }

    def _blocks(self, points: np.ndarray) -> list[tuple[Continuous, np.ndarray]]:
        """Return the coordinates of each draw that varies."""
        distributions = [distribution for _, distribution in self._varied]
        ends = np.cumsum([distribution.size for distribution in distributions])
        return list(zip(distributions, np.split(points, ends, axis=1)[:-1], strict=True))

    def _columns(self, points: int, varied: list[list[np.ndarray]]) -> Columns:
        """Return the columns of all draws, the held ones too, in the order of the file."""
        columns = {name: np.full(points, value) for name, value in self.held.items()}
        for (names, _), values in zip(self._varied, varied, strict=True):
            columns |= dict(zip(names, values, strict=True))
        return {name: np.ascontiguousarray(columns[name]) for draw in self.campaign.draws for name in draw.names}

    def _coordinates(self, draw: Draw) -> tuple[tuple[str, ...], Continuous] | None:
        """Return the names and the distribution of a draw; None where it is held. Raises InputError."""
        distribution = draw.distribution
        values = distribution.values if isinstance(distribution, Discrete) else ()
        given = [name for name in draw.names if name in self.held]
        if given:
            if len(given) < len(draw.names):
                lacking = ", ".join(name for name in draw.names if name not in given)
                raise InputError("`hold`", given[0], f"is drawn together with {lacking}", "hold all of them or none")
            if values and self.held[draw.name] not in values:
                known = ", ".join(f"{value:g}" for value in values)
                raise InputError("`hold`", draw.name, f"{self.held[draw.name]:g} is none of its values", f"use {known}")
            return None
        if isinstance(distribution, Continuous):
            return draw.names, distribution
        problem = f"a {distribution.keyword} has single values, and this study goes between them"
        remedy = f"hold it: `hold` {draw.name}={values[0]:g}, or another value"
        raise InputError(self.campaign.file, f"draw.{draw.name}", problem, remedy)
