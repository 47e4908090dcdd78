"""Verbs for studies: stability of a system's loops; rare, worst and sensitivity for a campaign's dispersions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, TypedDict

from ..choices import MarginKind
from ..declaration import Argument, Verb
from ..option import EMPTY, FilePath, Option
from ..simulation_options import Overwrite, ReportFiles, RequireOptions, Seed, SystemKeywords, Workers
from .campaigns import CAMPAIGN, SYSTEM, CampaignOptions, TrialsOptions

PAPER = "lunar_terminal_guidance --campaign paper --compare guidance=analytic_guidance"  # campaign of the examples


class StabilityOptions(SystemKeywords, TrialsOptions, total=False):
    """Options of stability"""

    loops: Annotated[
        Sequence[str],
        Option(
            "a loop of the SSD, or COMPONENT.CONNECTOR to cut; default: all loops of the SSD",
            (),
            metavar="NAME",
            flag="loop",
        ),
    ]
    at: Annotated[
        float | Sequence[float],
        Option(
            "times of the operating points, s; default: those of the SSD, for a cut 0",
            (),
            unit="s",
            metavar="T,...",
            comma=True,
        ),
    ]
    campaign: Annotated[
        FilePath | None,
        Option("disperse the margins over a campaign, by name or .toml", metavar="NAME", completer="campaigns"),
    ]
    configuration: Annotated[str | None, Option("one of the campaign's configurations", metavar="NAME")]
    seed: Seed
    trial: Annotated[int | None, Option("study one trial of the campaign instead", metavar="K")]
    workers: Annotated[
        int | None, Option("operating points studied in parallel; default: one per processor", metavar="N")
    ]


class StabilityFiles(ReportFiles, total=False):
    """Files"""

    data: Annotated[
        FilePath | None,
        Option(
            "write loop responses and A, B, C, D for python-control and MATLAB to a folder",
            metavar="DIR",
            is_folder=True,
        ),
    ]


STABILITY = Verb(
    "stability",
    "compute margins, poles and robustness of a system's loops",
    (SYSTEM,),
    options=StabilityOptions,
    files=StabilityFiles,
    examples={
        "perilune stability robot_rendezvous --loop attitude --parameters paper.ssv "
        "--report stability.html": "one of the loops that the system declares",
        "perilune stability lunar_terminal_guidance --loop guidance.thrust_acceleration "
        "--at 20": "a loop broken at one connector, in a system that declares none",
    },
    not_met="a requirement is not met or withheld, or something could not be studied",
)


class ConditionOptions(TypedDict, total=False):
    """Fixed inputs, noise and workers of a study"""

    hold: Annotated[
        Mapping[str, float], Option("fix a dispersed input (required for discrete inputs)", EMPTY, metavar="NAME=VALUE")
    ]
    noise_trial: Annotated[
        int | None,
        Option("use the noise realisation of trial K in all simulations; default: random noise", metavar="K"),
    ]
    workers: Workers
    output: Annotated[FilePath | None, Option("write the results to a folder", metavar="DIR")]
    overwrite: Overwrite


class RareOptions(CampaignOptions, ConditionOptions, RequireOptions, total=False):
    """Options of rare"""

    failure: Annotated[
        str | None,
        Option("failure condition over metrics and inputs; default: the trial is no success", metavar="EXPRESSION"),
    ]
    samples: Annotated[int, Option("simulations per level", 4500, metavar="N", minimum=100)]
    least: Annotated[float, Option("smallest probability of interest", 1e-9, metavar="P", above=0.0)]


class WorstOptions(CampaignOptions, ConditionOptions, RequireOptions, total=False):
    """Options of worst"""

    metric: Annotated[
        str | None,
        Option(
            "objective over metrics and inputs, the larger the worse; default: the margin to the success condition",
            metavar="EXPRESSION",
        ),
    ]
    loop: Annotated[
        str | None,
        Option(
            "instead minimise a stability margin of this loop, or of a loop cut at COMPONENT.CONNECTOR", metavar="NAME"
        ),
    ]
    margin: Annotated[MarginKind | None, Option("margin to minimise; default: disk")]
    point: Annotated[str | None, Option("operating point of the loop; default: the only one", metavar="NAME")]
    at: Annotated[float | None, Option("time of the operating point of a cut, s; default: 0", unit="s", metavar="T")]
    sigmas: Annotated[float, Option("search box of normal inputs, in standard deviations", 3.0, metavar="K", above=0.0)]
    flights: Annotated[int | None, Option("number of simulations; default: 2000, or 500 for a margin", metavar="N")]
    realisations: Annotated[
        int | None,
        Option(
            "noise realisations per point; default: 5, or 1 for a margin; the worst point is repeated with 10 K "
            "new realisations",
            metavar="K",
        ),
    ]
    quantile: Annotated[
        float | None,
        Option(
            "quantile of the realisations, from best to worst: 0.5 is the median, 1 the worst; default: 0.5",
            metavar="Q",
        ),
    ]


class SensitivityOptions(CampaignOptions, ConditionOptions, total=False):
    """Options of sensitivity"""


RARE = Verb(
    "rare",
    "estimate the probability of a rare failure, and its most probable failure points",
    (SYSTEM, CAMPAIGN),
    options=RareOptions,
    files=ReportFiles,
    examples={
        f"perilune rare {PAPER} --failure 'flight_time > 220' --samples 500 "
        "--output long_flights": "the probability of a long flight, from few simulations per level",
        f"perilune batch {PAPER} "
        "--draws long_flights/failures.parquet": "the most probable long flights, simulated again",
    },
    not_met="a --require is not met",
)
WORST = Verb(
    "worst",
    "search a campaign's dispersions for the worst value of a metric or of a stability margin",
    (SYSTEM, CAMPAIGN),
    options=WorstOptions,
    files=ReportFiles,
    examples={
        f"perilune worst {PAPER} --metric flight_time --flights 600 "
        "--output longest": "the longest flight within the search box"
    },
    not_met="a --require is not met",
)
SENSITIVITY = Verb(
    "sensitivity",
    "compute Sobol' indices: which dispersed inputs drive the metrics",
    (
        SYSTEM,
        CAMPAIGN,
        Argument(
            "base",
            "N",
            "base sample size, a power of two: N (inputs + 2) simulations, with noise N (inputs + 3)",
            is_option=True,
            read=int,
        ),
    ),
    options=SensitivityOptions,
    files=ReportFiles,
    examples={f"perilune sensitivity {PAPER} --base 64": "which dispersed inputs drive the metrics"},
)
