"""Verbs that simulate: run, and the campaign verbs batch, prepare, shard, merge, replay, compare and show."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, TypedDict

from ..choices import Engine
from ..declaration import Argument, NoOptions, Verb
from ..option import EMPTY, FilePath, Option
from ..simulation_options import (
    Overwrite,
    ReportFiles,
    RequireOptions,
    Seed,
    SimulationOptions,
    SystemKeywords,
    TrustOptions,
    UntilDecided,
    Workers,
)

SYSTEM = Argument(
    "system",
    "SYSTEM",
    "a name under ssp_systems, a folder, an .ssp file, or an .fmu for a stand-alone simulation",
    completer="systems_and_fmu_files",
)


class RunOptions(SystemKeywords, SimulationOptions, RequireOptions, total=False):
    """Options of run"""

    record: Annotated[
        Sequence[str],
        Option(
            "also record this local variable or parameter; may be repeated",
            (),
            metavar="COMPONENT.VARIABLE",
        ),
    ]


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
    function="run.simulate",
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

CAMPAIGN = Argument(
    "campaign", "NAME", "a campaign of the system, or a .toml file", completer="campaigns", is_option=True
)
FOLDER = Argument("folder", "DIR", "the folder of a campaign, written by batch or prepare")
OF_CAMPAIGN = "a requirement of the campaign is not met or undecided, a --require is not met, or a simulation failed"


class CampaignOptions(SystemKeywords, SimulationOptions, total=False):
    """Options of all simulations of a campaign"""

    seed: Seed
    compare: Annotated[
        Mapping[str, FilePath | Sequence[FilePath]],
        Option("compare these FMUs in a slot on the same samples", EMPTY, metavar="SLOT=A,B,C", comma=True),
    ]
    configuration: Annotated[
        str | None,
        Option("use only this configuration of the campaign, or this compared FMU", metavar="NAME"),
    ]


class TrialsOptions(TypedDict, total=False):
    """Choice of trials"""

    trials: Annotated[int | None, Option("number of trials; default: the campaign's", metavar="N")]
    draws: Annotated[
        FilePath | None,
        Option(
            "read the samples from a file, one row per trial, instead of drawing them",
            metavar="F.parquet",
            completer="parquet_files",
        ),
    ]


class ExecutionOptions(TypedDict, total=False):
    """Execution of simulations"""

    workers: Workers
    engine: Annotated[
        Engine | None,
        Option("parallel threads or processes; default: threads where the FMUs allow them"),
    ]
    scheduler: Annotated[str | None, Option("run on the workers of this dask scheduler instead", metavar="ADDRESS")]
    retry_crashed: Annotated[
        bool, Option("simulate the stored shards again in which trials crashed, hung or ran out of memory", False)
    ]


class ShardOptions(ExecutionOptions, TrustOptions, total=False):
    """Options of shard"""


class MetricsOptions(TypedDict, total=False):
    """Choice of printed metrics"""

    metrics: Annotated[
        Sequence[str],
        Option(
            "print this metric, or `all`; may be repeated; default: the metrics of success and requirements, else all",
            (),
            metavar="NAME|all",
        ),
    ]


class MergeOptions(RequireOptions, MetricsOptions, total=False):
    """Options of merge"""


class BatchOptions(CampaignOptions, TrialsOptions, ExecutionOptions, RequireOptions, MetricsOptions, total=False):
    """Options of batch"""

    output: Annotated[FilePath | None, Option("write trials, samples and summary to a folder", metavar="DIR")]
    overwrite: Overwrite
    resume: Annotated[bool, Option("continue or extend the campaign in the folder of --output", False)]
    until_decided: UntilDecided


class BatchFiles(ReportFiles, total=False):
    """Files"""

    trace: Annotated[
        FilePath | None,
        Option(
            "describe the campaign in --output as a simulation task of SSP-LS-Traceability",
            metavar="F.stmd",
            suffixes=(".stmd",),
            needs="output",
            writer="write_task",
        ),
    ]


class CompareOptions(MetricsOptions, total=False):
    """Options of compare"""

    reference: Annotated[
        str | None, Option("variant that others are compared with; default: the first", metavar="VARIANT")
    ]


class ShowOptions(TypedDict, total=False):
    """Options of show"""

    port: Annotated[int | None, Option("port to listen on; default: a free one", metavar="N", minimum=1, maximum=65535)]


class PrepareOptions(CampaignOptions, TrialsOptions, total=False):
    """Options of prepare"""

    overwrite: Annotated[bool, Option("overwrite existing results in the folder", False)]
    resume: Annotated[bool, Option("continue or extend the campaign in the folder", False)]
    until_decided: UntilDecided


class ReplayOptions(CampaignOptions, TrialsOptions, RequireOptions, total=False):
    """Options of replay"""

    campaign: Annotated[
        FilePath | None,
        Option(
            "replay a trial of this campaign of the system SOURCE, without a folder",
            metavar="NAME",
            completer="campaigns",
        ),
    ]


BATCH = Verb(
    "batch",
    "simulate a campaign: many trials, variants compared on the same samples",
    (SYSTEM, CAMPAIGN),
    options=BatchOptions,
    files=BatchFiles,
    examples={
        "perilune batch lunar_terminal_guidance --campaign paper --trials 50 --output results "
        "--report batch.html": "three guidance laws on the same fifty samples",
    },
    not_met=OF_CAMPAIGN,
)
PREPARE = Verb(
    "prepare",
    "write a campaign to a folder, to be simulated by `shard`",
    (SYSTEM, CAMPAIGN, Argument("output", "DIR", "the folder to write", is_option=True)),
    options=PrepareOptions,
    function="shard.prepare",
    examples={
        "perilune prepare lunar_terminal_guidance --campaign paper --trials 100 "
        "--output parts": "the campaign in a folder",
    },
)
SHARD = Verb(
    "shard",
    "simulate some shards of a prepared campaign, or of an unfinished batch",
    (FOLDER, Argument("numbers", "K", "numbers of shards, from 0 on; A-B is a range", many=True)),
    options=ShardOptions,
    examples={
        "perilune prepare lunar_terminal_guidance --campaign paper --trials 100 --output parts": "a folder to share",
        "perilune shard parts 0-1": "its first shards, on any machine that has the folder",
    },
    not_met="a simulation failed, or workers or the scheduler ended repeatedly",
)
MERGE = Verb(
    "merge",
    "merge the shards of a campaign: summary, page, requirements",
    (FOLDER,),
    options=MergeOptions,
    files=ReportFiles,
    function="shard.merge",
    examples={
        "perilune prepare lunar_terminal_guidance --campaign paper --trials 50 --output shared": "a folder to share",
        "perilune shard shared 0-1": "all of its shards, on any machines",
        "perilune merge shared --report merged.html": "the same files as batch writes",
    },
    not_met=OF_CAMPAIGN,
)
REPLAY = Verb(
    "replay",
    "simulate a trial of a campaign again, with all signals",
    (
        Argument("source", "SOURCE", "the folder of a campaign; or a system, with --campaign", completer="systems"),
        Argument("trial", "TRIAL", "number of the trial; the first is 0", read=int),
    ),
    options=ReplayOptions,
    files=FlightFiles,
    examples={
        "perilune replay results 7 --configuration analytic_guidance "
        "--report trial.html": "a trial of a stored campaign, from its folder alone",
        "perilune replay lunar_terminal_guidance 7 --campaign paper --compare guidance=astar_guidance "
        "--output replay.csv": "a trial of a campaign that is not stored",
    },
    not_met="as for run, or the trial is not a success or differs from the stored trial",
)

COMPARE = Verb(
    "compare",
    "compare the variants of one or several stored campaigns on the same trials",
    (Argument("results", "RESULT", "an output folder of batch", many=True),),
    options=CompareOptions,
    files=ReportFiles,
    examples={
        "perilune batch lunar_terminal_guidance --campaign paper --trials 50 --output results": "what is compared",
        "perilune compare results --report compare.html": "rates, pairs of variants, trajectories, distributions",
    },
)
SHOW = Verb(
    "show",
    "explore stored campaigns of any size in a browser",
    (Argument("folders", "FOLDER", "an output folder of batch", many=True),),
    options=ShowOptions,
    files=NoOptions,
    examples={
        "perilune batch lunar_terminal_guidance --campaign paper --trials 50 --output results": "what is explored",
        "perilune show results": "prints a local address to open; Ctrl-C ends the server",
    },
)
