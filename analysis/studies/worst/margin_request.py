"""Request to search for the worst margin of a loop at one operating point, over a campaign."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ....common.errors import InputError
from ...campaigns.definition.plan import BatchPlan
from ...runtime.system.options import SystemOptions
from ...stability.dispersion import vary
from ...stability.point.point_study import PointStudy
from ...stability.request.declaration import LoopDeclaration, PointDeclaration
from ...stability.request.request import Request, Subject, read_request

OF_A_LOOP = ("margin", "point", "at")
OF_FLIGHTS = {  # options that do not apply to margins, with the remedy
    "metric": "give one of them",
    "compare": "select the FMU with `use`",
    "faults": "leave them out: margins are computed without faults",
    "input": "leave it out: margins are computed without inputs over time",
    "log": "use it with perilune run",
    "timeout": "leave it out",
}


@dataclass(frozen=True)
class MarginRequest:
    """Loop at an operating point, with a campaign; small enough to be sent to every worker."""

    request: Request
    loop: LoopDeclaration
    point: PointDeclaration

    @property
    def plan(self) -> BatchPlan:
        assert self.request.plan is not None
        return self.request.plan

    def open_request(self) -> PointStudy:
        """Return the study of the point with the campaign's layer and draws, to be closed by the caller.

        Raises InputError, StudyError.
        """
        (variant,) = self.plan.campaign.variants()
        layer = self.plan.campaign.layer_of(variant)
        subject = Subject(self.request.system, self.request.options).with_options(campaign=layer)
        return PointStudy(subject, self.point, [self.loop], vary(self.plan))


def check_options(loop: str | None, options: Mapping[str, object]) -> None:
    """Reject options, by name, that do not apply with a loop or apply only with a loop. Raises InputError."""
    for name in OF_A_LOOP if loop is None else ():
        if options[name] is not None:
            raise InputError(f"`{name}`", str(options[name]), "needs `loop`", "give `loop`")
    for name, remedy in OF_FLIGHTS.items() if loop is not None else ():
        if options[name]:
            raise InputError(f"`{name}`", "", "cannot be combined with `loop`", remedy)


def request_margin(
    system: str | Path,
    options: SystemOptions,
    *,
    campaign: str,
    configuration: str | None,
    loop: str,
    point: str | None,
    at: float | None,
    seed: int | None,
) -> MarginRequest:
    """Return the request for a system's loop, or for a connector cut at the time ``at`` (s), over a campaign's draws.

    ``point`` is required if the loop has several points, ``configuration`` if the campaign has several configurations.
    Raises InputError.
    """
    request = read_request(
        system,
        options,
        loops=[loop],
        at=() if at is None else (at,),
        campaign=campaign,
        configuration=configuration,
        seed=seed,
    )
    (studied_loop,) = request.declaration.loops
    if point is None and len(studied_loop.points) > 1:
        problem = f"is studied at {len(studied_loop.points)} points, but a search needs one"
        points = " or ".join(f"`point` {name}" for name in studied_loop.points)
        raise InputError("`loop`", loop, problem, f"choose: {points}")
    if point is not None and point not in studied_loop.points:
        raise InputError("`point`", point, f"{loop} has no such point", f"give {' or '.join(studied_loop.points)}")
    return MarginRequest(request, studied_loop, request.point(point or studied_loop.points[0]))
