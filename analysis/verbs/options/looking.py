"""The verbs that look at what there is: list, describe, validate, benchmark, docs."""

from __future__ import annotations

from typing import Annotated, TypedDict

from .option import Option
from .system import SystemOptions
from .verb import Argument, Verb

LIST = Verb(
    "list",
    "list systems with their parameter sets, campaigns and loops; laws, searches and FMUs",
    module="inventory",
    function="inventory",
    examples={
        "perilune list": "names to give to the other verbs",
    },
)


class DescribeOptions(SystemOptions, total=False):
    """Options of describe"""

    campaign: Annotated[
        str | None,
        Option(
            "of a system: a campaign with all that it extends, each value with its file and line",
            metavar="NAME",
            completer="campaigns",
        ),
    ]


DESCRIBE = Verb(
    "describe",
    "describe a system, an FMU or a slot: connectors, parameters with their values, compatible FMUs",
    (
        Argument("what", "SYSTEM|FMU|SLOT", "a system, an FMU by name or file, or a slot", "systems_and_fmus"),
        Argument("component", "COMPONENT", "of a system: one component with all its variables", optional=True),
    ),
    options=DescribeOptions,
    examples={
        "perilune describe lunar_landing": "components, connections, values, compatible FMUs",
        "perilune describe lunar_landing guidance": "one component with all its variables",
        "perilune describe terminal_guidance": "a slot: connectors, parameters, its FMUs",
        "perilune describe entry_attitude --campaign cases": "a campaign, each value with file and line",
    },
)

VALIDATE = Verb(
    "validate",
    "check systems, FMUs, parameter sets and campaigns",
    (
        Argument(
            "paths", "PATH", "a system, .ssp, .fmu, .ssv, law .json or campaign .toml", "systems_and_files", many=True
        ),
    ),
    options=SystemOptions,
    examples={
        "perilune validate lunar_landing": "a system; a folder, .ssp, .fmu, .ssv or campaign .toml likewise",
    },
)


class BenchmarkOptions(TypedDict, total=False):
    """Options of benchmark"""

    steps: Annotated[int, Option("communication steps of a simulation", 2500, metavar="N")]
    repeats: Annotated[int, Option("simulations that are timed", 5, metavar="N")]


BENCHMARK = Verb(
    "benchmark",
    "time a communication step, compared with FMPy",
    options=BenchmarkOptions,
    examples={
        "perilune benchmark --steps 500 --repeats 2": "a shorter run than the default",
    },
)


class DocsOptions(TypedDict, total=False):
    """Options of docs"""

    print: Annotated[bool, Option("print the path of its first page, and open nothing", False)]


DOCS = Verb(
    "docs",
    "open the documentation in a browser",
    options=DocsOptions,
    examples={
        "perilune docs --print": "the path of its first page",
    },
)
