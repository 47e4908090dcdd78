"""The verbs that simulate once: run."""

from __future__ import annotations

from typing import Annotated

from .option import FilePath, Option
from .system import ReportFiles, RequireOptions, SimulationOptions, SystemOptions
from .verb import Argument, Verb

SYSTEM = Argument(
    "system",
    "SYSTEM",
    "a name under ssp_systems, a folder, an .ssp file, or an .fmu for a stand-alone simulation",
    completer="systems_and_fmu_files",
)


class RunOptions(SystemOptions, SimulationOptions, RequireOptions, total=False):
    """Options of run"""


class FlightFiles(ReportFiles, total=False):
    """Files"""

    output: Annotated[
        FilePath | None,
        Option("write all signals to F.csv or F.parquet", metavar="F", suffixes=(".csv", ".parquet")),
    ]


RUN = Verb(
    "run",
    "simulate a system once",
    (SYSTEM,),
    options=RunOptions,
    files=FlightFiles,
    function="simulate",
    examples={
        "perilune run lunar_terminal_guidance --report flight.html": "one landing and its page",
        "perilune run lunar_landing --use guidance=astar_guidance --parameters ideal.ssv "
        "--output flight.csv": "another guidance law, no sensor errors; all signals to a file",
        "perilune run lunar_terminal_guidance --require 'time < 300'": "exit status 1 if it takes longer",
        "perilune export flat_moon_lander": "an FMU for any tool",
        "perilune run flat_moon_lander.fmu --stop-time 20 --log warning --timeout 60 "
        "--output lander.csv": "the FMU alone, with its log messages and a 60 s wall-clock limit",
    },
    not_met="a limit of the SSD or a --require is violated or not evaluated, or the simulation did not complete",
)
