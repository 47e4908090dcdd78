"""Verbs of design: law and search for network operators, transfer and bounds for least propellant."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, TypedDict

from ...design.trajectories.vehicle import (
    HOVER_MARGINS,
    HOVER_TRANSFER,
    HOVER_VEHICLE,
    LANDING,
    LANDING_VEHICLE,
    Margins,
)
from ...options.declaration import Argument, Verb
from ...options.declared.campaigns import CAMPAIGN, SYSTEM
from ...options.option import FilePath, Option
from ...options.simulation_options import JsonFile, ReportFiles, Seed, SystemKeywords

MOST_INTERVALS = 100_000
NO_PLAN = "no such plan exists, or it needs more propellant than is on board"
SEARCH_FILE = Argument(
    "search", "F.toml", "a campaign with a table [network_operator]: its name in laws/searches, or a path", "searches"
)
LANDING_SYSTEM = Argument(
    "system",
    "SYSTEM",
    "system whose landing is bounded: a name under ssp_systems, a folder or an .ssp file; default: the published case",
    "systems",
    optional=True,
)


class LawOptions(TypedDict, total=False):
    """Options of design law"""

    component: Annotated[
        str, Option("component that the parameter set is for", "guidance", metavar="NAME", needs="output")
    ]


class LawFiles(JsonFile, total=False):
    """Files"""

    output: Annotated[
        FilePath | None,
        Option("write the parameter set of the law", metavar="F.ssv", suffixes=(".ssv",), writer="write_parameters"),
    ]
    graph: Annotated[
        FilePath | None, Option("draw the graph of the law", metavar="F.svg", suffixes=(".svg",), writer="write_graph")
    ]


LAW = Verb(
    "design law",
    "print a network operator's law as a formula, or write it as a parameter set or a drawing",
    (Argument("name", "LAW", "the name of a law in laws/, or the path of a .json file", "laws"),),
    options=LawOptions,
    files=LawFiles,
    function="laws.law",
    examples={
        "perilune design law diveev_2013": "the published law as a formula",
        "perilune design law diveev_2013 --output law.ssv "
        "--graph law.svg": "a parameter set for guidance, and a drawing",
    },
)


class SearchOptions(TypedDict, total=False):
    """Options of design search"""

    seed: Seed
    workers: Annotated[int | None, Option("laws to evaluate in parallel; default: one per processor", metavar="N")]
    output: Annotated[FilePath | None, Option("write checkpoints, Pareto set and law to a folder", metavar="DIR")]
    resume: Annotated[bool, Option("continue from the checkpoint in the folder of --output", False)]
    evaluations: Annotated[
        int | None, Option("end after the generation in which the number of evaluated laws reaches N", metavar="N")
    ]


SEARCH = Verb(
    "design search",
    "search for a network operator's law, every candidate simulated in its system",
    (SEARCH_FILE,),
    options=SearchOptions,
    function="laws.synthesize",
    examples={
        "perilune design search lunar_landing_5_deg_s "
        "--output laws": "ends immediately, since the published law succeeds from all nine starts",
    },
    not_met="no law was found that succeeds in every trial",
)


def _defaults(name: str, unit: str) -> str:
    """Return the unit of a number of the vehicle, and its published values, as text."""
    values = f"{getattr(HOVER_VEHICLE, name):g} (transfer), {getattr(LANDING_VEHICLE, name):g} (bound)"
    return f", {unit}; default: {values}"


class VehicleOptions(TypedDict, total=False):
    """Vehicle"""

    mass: Annotated[float | None, Option(f"mass at the start{_defaults('mass', 'kg')}", unit="kg", above=0.0)]
    dry_mass: Annotated[
        float | None, Option(f"mass without propellant{_defaults('dry_mass', 'kg')}", unit="kg", minimum=0.0)
    ]
    specific_impulse: Annotated[
        float | None, Option(f"specific impulse of the engine{_defaults('specific_impulse', 's')}", unit="s", above=0.0)
    ]
    maximum_thrust: Annotated[
        float | None, Option(f"maximum thrust of the engine{_defaults('maximum_thrust', 'N')}", unit="N", above=0.0)
    ]
    minimum_thrust: Annotated[
        float | None, Option(f"minimum thrust of the engine{_defaults('minimum_thrust', 'N')}", unit="N", minimum=0.0)
    ]


class TransferOptions(VehicleOptions, total=False):
    """Options of design transfer"""

    distance: Annotated[
        float | None, Option(f"downrange distance, m; default: {HOVER_TRANSFER.distance:g}", unit="m", minimum=0.0)
    ]
    descent: Annotated[
        float | None,
        Option(f"height above the end, m; default: {HOVER_TRANSFER.descent:g}", unit="m", above=0.0),
    ]
    gravity: Annotated[
        float | None, Option(f"uniform gravity, m/s2; default: {HOVER_TRANSFER.gravity:g}", unit="m/s2", above=0.0)
    ]
    duration: Annotated[
        float | None,
        Option(
            "duration, s; default: the duration of least propellant",
            unit="s",
            metavar="T",
            flag="t7",
            above=0.0,
        ),
    ]
    margins: Annotated[
        bool | Margins,
        Option(
            f"leave control margins: throttle {HOVER_MARGINS.minimum_throttle:g} to "
            f"{HOVER_MARGINS.maximum_throttle:g}, {math.degrees(HOVER_MARGINS.angular_acceleration):g} deg/s2; "
            "default: the limits of the vehicle",
            False,
        ),
    ]
    maximum_throttle: Annotated[
        float | None,
        Option("maximum throttle, fraction of the maximum thrust, as a control margin", above=0.0, maximum=1.0),
    ]
    minimum_throttle: Annotated[
        float | None,
        Option("minimum throttle, fraction of the maximum thrust, as a control margin", minimum=0.0, maximum=1.0),
    ]
    angular_acceleration: Annotated[
        float | None,
        Option("angular acceleration as a control margin, deg/s2; the vehicle's is 1", unit="deg/s2", above=0.0),
    ]
    optimum: Annotated[bool, Option("also compute the true optimum by direct multiple shooting", False)]
    adjoint: Annotated[
        bool,
        Option(
            "integrate the adjoint system along the true optimum and report residuals of the optimality conditions",
            False,
        ),
    ]
    finite_switches: Annotated[
        bool,
        Option("also compute the best profile whose angular acceleration switches finitely often", False),
    ]
    free_fall: Annotated[
        bool, Option("also compute the programme that becomes vertical in free fall and then brakes again", False)
    ]
    turn_begun: Annotated[
        float,
        Option("fraction of the last turn that is completed before engine shutdown", 0.0, minimum=0.0, maximum=0.9),
    ]
    distances: Annotated[
        Sequence[float],
        Option(
            "also compare both programmes at these distances, m", (), unit="m", metavar="X,...", comma=True, minimum=0.0
        ),
    ]
    bound: Annotated[bool, Option("also compute the bound of a point mass by convex optimisation", False)]
    curves: Annotated[bool, Option("also compute propellant over t7 and over distance", False)]
    intervals: Annotated[
        int | None, Option("intervals of optimum and bound; default: 320 and 240", minimum=10, maximum=MOST_INTERVALS)
    ]


TRANSFER = Verb(
    "design transfer",
    "plan a transfer between two hovers: parametric programme, true optimum, point-mass bound",
    options=TransferOptions,
    files=ReportFiles,
    function="plans.plan_hover_transfer",
    objects={
        "transfer": "`perilune.Transfer`: distance, descent and gravity; default: the published case",
        "vehicle": "`perilune.Vehicle`: masses, specific impulse and limits; default: the vehicle of the "
        "published case",
    },
    examples={"perilune design transfer --margins": "from hover to hover, with control margins"},
    not_met=NO_PLAN,
)


class BoundOptions(SystemKeywords, VehicleOptions, total=False):
    """Options of design bound"""

    range: Annotated[
        float | None, Option(f"ground distance from the site to the start, m; default: {LANDING.range:g}", above=0.0)
    ]
    altitude: Annotated[float | None, Option(f"altitude of the start, m; default: {LANDING.altitude:g}", above=0.0)]
    speed: Annotated[float | None, Option(f"speed at the start, m/s; default: {LANDING.speed:g}", above=0.0)]
    climb: Annotated[
        float | None,
        Option(
            f"flight-path angle at the start, deg; default: {math.degrees(LANDING.climb):g}",
            unit="deg",
            minimum=-89.0,
            maximum=89.0,
        ),
    ]
    target_altitude: Annotated[
        float | None,
        Option(
            f"height above the site at which the landing ends at rest, m; default: {LANDING.target_altitude:g}",
            minimum=0.0,
        ),
    ]
    radius: Annotated[float | None, Option(f"radius of the Moon, m; default: {LANDING.radius:g}", above=0.0)]
    gravitational_parameter: Annotated[
        float | None,
        Option(f"gravitational parameter of the Moon, m3/s2; default: {LANDING.gravitational_parameter:g}", above=0.0),
    ]
    direct: Annotated[bool, Option("check the bound by a direct method", False)]
    intervals: Annotated[
        int | None, Option("intervals of bound and check; default: 240", minimum=10, maximum=MOST_INTERVALS)
    ]
    store: Annotated[bool, Option("store the bound in the system's folder, where pages of simulations read it", False)]


BOUND = Verb(
    "design bound",
    "bound the propellant of a single-burn braking and landing, for a point mass with free attitude",
    (LANDING_SYSTEM,),
    options=BoundOptions,
    files=ReportFiles,
    function="plans.plan_landing_bound",
    objects={
        "landing": "`perilune.Landing`: start, target and Moon; default: the landing of the system, else the "
        "published case",
        "vehicle": "`perilune.Vehicle`: masses, specific impulse and limits; default: the vehicle of the system, "
        "else the published case",
    },
    examples={"perilune design bound": "a lower bound of the propellant of any such landing; needs the extra plan"},
    not_met=NO_PLAN,
)


class BoundsOptions(TypedDict, total=False):
    """Options of design bounds"""

    trials: Annotated[int | None, Option("number of trials; default: the campaign's", metavar="N")]
    intervals: Annotated[int | None, Option("intervals of each bound; default: 80", minimum=10, maximum=MOST_INTERVALS)]
    workers: Annotated[int | None, Option("bounds to compute in parallel; default: one per processor", metavar="N")]
    store: Annotated[bool, Option("store the table where [lookup.bound] of the campaign reads it", False)]


BOUNDS = Verb(
    "design bounds",
    "bound the propellant of each trial of a campaign, for a point mass with free attitude",
    (SYSTEM, CAMPAIGN),
    options=BoundsOptions,
    files=JsonFile,
    function="bounds.bound_trials",
    examples={
        "perilune design bounds lunar_landing --campaign laws_approach --trials 2": "lower bounds of the "
        "propellant of these descents; needs the extra plan"
    },
    not_met="a trial has no bound: its target is out of reach",
)
