"""The verb stability."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from .campaigns import TrialsOptions
from .flights import SYSTEM
from .option import FilePath, Option
from .system import ReportFiles, SystemOptions
from .verb import Verb


class StabilityOptions(SystemOptions, TrialsOptions, total=False):
    """Options of stability"""

    loops: Annotated[
        Sequence[str],
        Option(
            "a loop of the SSD, or COMPONENT.CONNECTOR to cut; default: all loops of the SSD",
            (),
            flag="loop",
            metavar="NAME",
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
    seed: Annotated[int | None, Option("instead of the campaign's root seed", metavar="S")]
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
