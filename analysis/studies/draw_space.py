"""Space of a campaign's draws, as independent standard normal variables and as a box.

The coordinates of each distribution are defined in ``distributions.py``.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...common.errors import InputError, suggestion
from ..campaigns.definition.campaign import Campaign
from ..campaigns.definition.distributions import Discrete
from ..campaigns.draws.interfaces import Columns, Continuous, Draw


class DrawSpace:
    """Space of a campaign's draws, spanned by the random draws; draws in ``held`` have one value everywhere.

    Choices and grids have no coordinates and must be held. Latin hypercubes and Sobol sequences are treated as the
    uniform draws that they sample. ``size`` is the number of coordinates, in the order of the file; jointly normal
    values have one coordinate along each axis of their covariance with an eigenvalue above 0. Raises InputError for a
    draw that must be held but is not, for a held value that the campaign does not draw or cannot take, and, unless
    ``may_be_empty``, if no draw varies.
    """

    def __init__(
        self, campaign: Campaign, held: Mapping[str, float] | None = None, *, may_be_empty: bool = False
    ) -> None:
        self.campaign = campaign
        self.held = dict(held or {})
        names = [name for draw in campaign.draws for name in draw.names]
        for name in self.held:
            if name not in names:
                raise InputError("`hold`", name, f"{campaign.file} does not draw this value", suggestion(name, names))
        self._varied = [pair for pair in map(self._coordinates, campaign.draws) if pair is not None]
        self.size = sum(distribution.size for _, distribution in self._varied)
        if not may_be_empty:
            self.check_varies()

    def check_varies(self) -> None:
        """Reject a space in which no draw varies. Raises InputError."""
        if not self.size:
            raise InputError(self.campaign.file, "draw", "no draw varies", "declare a [draw.NAME], or hold fewer draws")

    @property
    def independent(self) -> bool:
        """True if each coordinate is a single draw."""
        return all(len(names) == 1 for names, _ in self._varied)

    @property
    def names(self) -> list[str]:
        return [name for names, _ in self._varied for name in names]

    def from_normals(self, u: np.ndarray) -> Columns:
        """Return draws, as columns by name, for independent standard normal values ``u`` (points, size)."""
        return self._columns(len(u), [distribution.from_normals(block) for distribution, block in self._blocks(u)])

    def to_normals(self, columns: Mapping[str, np.ndarray]) -> np.ndarray:
        """Return standard normal values of draws, the inverse of `from_normals`; infinite at an interval's ends."""
        return np.column_stack(
            [distribution.to_normals([columns[name] for name in names]) for names, distribution in self._varied]
        )

    def from_box(self, points: np.ndarray, sigmas: float) -> Columns:
        """Return draws for ``points`` (points, size) of the unit cube, which represents the box.

        The box consists of the intervals of bounded draws and of ``sigmas`` standard deviations of normal draws, along
        the axes of the covariance for jointly normal draws.
        """
        blocks = self._blocks(points)
        return self._columns(len(points), [distribution.from_box(block, sigmas) for distribution, block in blocks])

    def to_box(self, columns: Mapping[str, np.ndarray], sigmas: float) -> np.ndarray:
        """Return coordinates for draws, the inverse of `from_box`; outside the box they are below 0 or above 1."""
        return np.column_stack(
            [distribution.to_box([columns[name] for name in names], sigmas) for names, distribution in self._varied]
        )

    def ranges(self, sigmas: float) -> dict[str, tuple[float, float]]:
        """Return the minimum and maximum, in the box of `from_box`, of each draw that varies.

        Jointly normal values do not reach their limits together, since the box is along the axes of their covariance.
        """
        return {
            name: ends
            for names, distribution in self._varied
            for name, ends in zip(names, distribution.ranges(sigmas), strict=True)
        }

    def _blocks(self, points: np.ndarray) -> list[tuple[Continuous, np.ndarray]]:
        """Return the distribution of each draw that varies, with the range of its coordinates."""
        distributions = [distribution for _, distribution in self._varied]
        ends = np.cumsum([distribution.size for distribution in distributions])
        return list(zip(distributions, np.split(points, ends, axis=1)[:-1], strict=True))

    def _columns(self, points: int, varied: list[list[np.ndarray]]) -> Columns:
        """Return the columns of all draws, including held ones, in the order of the file."""
        columns = {name: np.full(points, value) for name, value in self.held.items()}
        for (names, _), values in zip(self._varied, varied, strict=True):
            columns |= dict(zip(names, values, strict=True))
        return {name: np.ascontiguousarray(columns[name]) for draw in self.campaign.draws for name in draw.names}

    def _coordinates(self, draw: Draw) -> tuple[tuple[str, ...], Continuous] | None:
        """Return the names and the distribution of a draw, or None if it is held. Raises InputError."""
        distribution = draw.distribution
        values = distribution.values if isinstance(distribution, Discrete) else ()
        fixed = [name for name in draw.names if name in self.held]
        if fixed:
            if len(fixed) < len(draw.names):
                lacking = ", ".join(name for name in draw.names if name not in fixed)
                raise InputError("`hold`", fixed[0], f"is drawn together with {lacking}", "hold all of them or none")
            if values and self.held[draw.name] not in values:
                known = ", ".join(f"{value:g}" for value in values)
                raise InputError(
                    "`hold`", draw.name, f"{self.held[draw.name]:g} is not one of its values", f"use {known}"
                )
            return None
        if isinstance(distribution, Continuous):
            return draw.names, distribution
        problem = f"a {distribution.keyword} has discrete values, but this study needs a continuous draw"
        remedy = f"hold this draw: `hold` {draw.name}={values[0]:g}, or another value"
        raise InputError(self.campaign.file, f"draw.{draw.name}", problem, remedy)
