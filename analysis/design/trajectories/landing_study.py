"""Lower bound on the propellant of a single-burn braking and landing, and its verification by the direct method."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ....common.progress import progress_bar
from .declared_bound import Inputs
from .least_time import BOUND_INTERVALS, least_propellant
from .multiple_shooting import direct_propellant
from .path import PlannedPath
from .point_mass import PointMassProblem, landing_problem
from .stored_bound import StoredBound, digest
from .vehicle import Landing, Vehicle


@dataclass(frozen=True)
class Direct:
    """Result of the direct method: the propellant as a fraction of the initial mass, and the duration (s)."""

    propellant_fraction: float
    duration: float


@dataclass(frozen=True)
class LandingStudy:
    """Bound of a landing; ``looseness`` (m/s2) is the slack of the convex form, ``direct`` is None if not requested.

    ``pieces`` contains the bound on the propellant (kg) of each phase into which a system divides its landing, by name.
    """

    vehicle: Vehicle
    landing: Landing
    bound: PlannedPath
    looseness: float
    direct: Direct | None
    pieces: Mapping[str, float]

    @property
    def propellant(self) -> float:
        """Bound on the propellant, kg."""
        return self.bound.propellant_fraction * self.vehicle.mass

    def to_stored_bound(self, inputs: Inputs) -> StoredBound:
        """Return the bound in the form stored for a system, with its inputs."""
        burns = tuple(self.bound.burns())
        return StoredBound(
            propellant=self.propellant,
            duration=self.bound.duration,
            intervals=self.bound.throttle.size,
            burns=burns,
            pieces=self.pieces,
            sha256=digest(inputs),
            inputs=inputs,
        )


def landing_study(
    vehicle: Vehicle,
    landing: Landing,
    *,
    direct: bool = False,
    intervals: int | None = None,
    pieces: Mapping[str, tuple[PointMassProblem, float]] | None = None,
) -> LandingStudy:
    """Compute the bound and, with ``direct``, its verification; ``pieces`` is the result of `pieces_of`.

    Raises `PlanError`, and InputError for a missing solver.
    """
    problem = landing_problem(vehicle, landing)
    count = intervals or BOUND_INTERVALS
    with progress_bar(total=1 + direct + len(pieces or {}), unit="part") as progress:
        path = least_propellant(problem, count)
        progress.update()
        check = Direct(*direct_propellant(problem, count)) if direct else None
        progress.update(direct)
        cut = {}
        for name, (part, mass) in (pieces or {}).items():
            cut[name] = least_propellant(part, count).propellant_fraction * mass
            progress.update()
    return LandingStudy(vehicle, landing, path.make_path(problem), path.slack, check, cut)
