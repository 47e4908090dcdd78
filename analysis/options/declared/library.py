"""Verbs about blocks and systems: list, describe, validate, docs, new, export and related ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, TypedDict

from ....common.paths import Build
from ..declaration import Argument, Verb
from ..option import EMPTY, FilePath, Option
from ..simulation_options import AssemblyOptions, ReportFiles, SystemKeywords, TrustOptions

PATHS = Argument(
    "paths", "PATH", "a system, .ssp, .fmu, .ssv, law .json or campaign .toml", "systems_and_files", many=True
)
NAME = Argument("name", "NAME", "lower-case letters, digits and underscores")
SLOT = Argument(
    "slot",
    "SLOT",
    "slot for which to write the block, shown by `perilune describe SLOT`; default: a block without a slot",
    "block_slots",
    optional=True,
    is_option=True,
)
EXPORTED = Argument(
    "name",
    "SYSTEM|FMU|BLOCK|FILE.py",
    "a system or its folder, a block of the library or of a .py file in this folder, or a file with blocks",
    "systems_and_fmus",
)

LIST = Verb(
    "list",
    "list systems with their parameter sets, campaigns and loops; laws, searches and FMUs",
    (
        Argument(
            "what",
            "KIND|WORD",
            "systems, campaigns, laws, searches or fmus; any other word is searched in names and descriptions",
            optional=True,
        ),
    ),
    function="inventory.inventory",
    examples={
        "perilune list": "names that the other verbs accept",
        "perilune list campaigns": "the campaigns of each system",
        "perilune list kalman": "entries with this word in name or description",
    },
)


class DescribeOptions(SystemKeywords, total=False):
    """Options of describe"""

    campaign: Annotated[
        str | None,
        Option(
            "of a system: show a campaign and the files that it extends, with file and line of each value",
            metavar="NAME",
            completer="campaigns",
        ),
    ]


DESCRIBE = Verb(
    "describe",
    "describe a system, an FMU or a slot: connectors, parameters with their values, compatible FMUs",
    (
        Argument("what", "SYSTEM|FMU|SLOT", "a system, an FMU by name or file, or a slot", "systems_and_fmus"),
        Argument("component", "COMPONENT", "of a system: show one component with all its variables", optional=True),
    ),
    options=DescribeOptions,
    files=ReportFiles,
    examples={
        "perilune describe lunar_landing": "components, connections, values, compatible FMUs",
        "perilune describe lunar_landing --report blocks.html": "the block diagram, with tables of its connections",
        "perilune describe lunar_landing guidance": "one component with all its variables",
        "perilune describe terminal_guidance": "a slot: connectors, parameters, its FMUs",
        "perilune describe entry_attitude --campaign cases": "a campaign, each value with file and line",
    },
)


class ValidateOptions(SystemKeywords, total=False):
    """Options of validate"""

    all_variants: Annotated[
        bool, Option("check every SSD of an archive, not only the one that would be simulated", False)
    ]


VALIDATE = Verb(
    "validate",
    "check systems, FMUs, parameter sets and campaigns",
    (PATHS,),
    options=ValidateOptions,
    examples={"perilune validate lunar_landing": "a system; a folder, .ssp, .fmu, .ssv or campaign .toml likewise"},
)


class VerifyOptions(TrustOptions, total=False):
    """Options of verify"""

    tolerance: Annotated[
        float | None,
        Option(
            "signals without a declared tolerance may differ by this fraction of their largest magnitude; "
            "default: 0 (the same bits) for Perilune's files, 1e-6 for other files",
            metavar="R",
            minimum=0.0,
        ),
    ]
    flavour: Annotated[Build | None, Option("build to use of an FMU given by name")]
    timeout: Annotated[float | None, Option("wall-clock limit of each simulation", metavar="T", unit="s")]


VERIFY = Verb(
    "verify",
    "simulate the reference trajectories inside FMUs and systems again, and check their files",
    (Argument("paths", "PATH", "an .fmu or .ssp, or the name of an FMU", "systems_and_fmus", many=True),),
    options=VerifyOptions,
    examples={
        "perilune export flat_moon_lander": "an FMU with its evidence inside",
        "perilune verify flat_moon_lander.fmu": "its trajectories simulated here and compared, its files checked",
    },
    not_met="a signal differs by more than its tolerance, a file was changed or is missing, or a simulation failed",
)


LISTING = 1e-9  # relative difference from which `diff` lists a signal


class DiffOptions(TypedDict, total=False):
    """Options of diff"""

    tolerance: Annotated[
        float | None,
        Option(
            "a signal may differ by this fraction of its largest magnitude; a larger difference or a missing "
            f"signal is a problem; without it, signals that differ by up to {LISTING:g} are summarised",
            metavar="R",
        ),
    ]


DIFF = Verb(
    "diff",
    "compare two runs, signal by signal",
    (
        Argument("first", "FIRST", "a .parquet or .csv written by `run --output` or by another tool"),
        Argument("second", "SECOND", "another one"),
    ),
    options=DiffOptions,
    files=ReportFiles,
    examples={
        "perilune run lunar_terminal_guidance --output analytic.parquet": "what is compared",
        "perilune run lunar_terminal_guidance --use guidance=astar_guidance --output astar.parquet": "with what",
        "perilune diff analytic.parquet astar.parquet --report diff.html": "both, and their differences",
    },
    not_met="a signal differs by more than --tolerance or, if this is given, is missing from one run",
)


class DocsOptions(TypedDict, total=False):
    """Options of docs"""

    print: Annotated[bool, Option("print the path of the first page instead of opening it", False)]


DOCS = Verb(
    "docs",
    "open the documentation in a browser",
    options=DocsOptions,
    examples={"perilune docs --print": "the path of its first page"},
    is_command_alone=True,
)


NEW_BLOCK = Verb(
    "new block",
    "write NAME.py, a template for your own block",
    (NAME, SLOT),
    function="new.new_block",
    examples={
        "perilune new block my_guidance --slot terminal_guidance": "my_guidance.py, which can be simulated unchanged"
    },
)

NEW_SYSTEM = Verb(
    "new system",
    "write the folder NAME, a template for your own system: blocks, parameter sets, campaign",
    (NAME,),
    function="new.new_system",
    examples={"perilune new system my_axis": "a folder with plant, controller, description, campaign, loop"},
)


class ComposeOptions(TypedDict, total=False):
    """Options of compose"""

    output: Annotated[
        FilePath | None,
        Option(
            "of a system: write its system.toml to F.toml, with all files that it refers to; default: print it",
            metavar="F.toml",
            suffixes=(".toml",),
        ),
    ]


COMPOSE = Verb(
    "compose",
    "write the SSD of a system from its system.toml, or a system.toml from a system",
    (Argument("what", "FILE.toml|SYSTEM", "a system.toml, or a system or its folder", "systems_and_files"),),
    options=ComposeOptions,
    examples={
        "perilune compose lunar_terminal_guidance": "its system.toml, printed",
        "perilune compose lunar_terminal_guidance --output landing/system.toml": "the same as a file to start from",
        "perilune compose landing/system.toml": "landing/SystemStructure.ssd",
    },
)


FmuPlatform = Literal[
    "linux64",
    "win64",
    "darwin64",
    "x86_64-linux",
    "aarch64-linux",
    "x86_64-windows",
    "x86_64-darwin",
    "aarch64-darwin",
]


class ExportOptions(AssemblyOptions, total=False):
    """Options of export"""

    as_fmu: Annotated[
        bool,
        Option(
            "of a system: write one FMU of FMI 2.0 for co-simulation, with the C of its components in one library",
            False,
        ),
    ]
    slots: Annotated[
        Mapping[str, str],
        Option(
            "with --as-fmu: candidates for a component; the parameter SLOT.use chooses one",
            EMPTY,
            metavar="SLOT=FMU,FMU...",
            flag="slot",
            completer="slots_with_fmus",
        ),
    ]
    expose: Annotated[
        Sequence[str],
        Option(
            "with --as-fmu: add a signal of a component as a local variable; the name of a vector adds all its "
            "elements",
            (),
            metavar="COMPONENT.VARIABLE",
        ),
    ]
    faults: Annotated[
        Sequence[str],
        Option(
            "with --as-fmu: add inputs for an override, a bias or a freeze of a connector or a tunable parameter",
            (),
            metavar="COMPONENT.NAME",
        ),
    ]

    fmi: Annotated[
        int,
        Option("version of FMI; 3: a native FMU of FMI 3.0, compiled here", 2, minimum=2, maximum=3, metavar="2|3"),
    ]
    platforms: Annotated[
        Sequence[FmuPlatform],
        Option(
            "of native FMUs: linux64, win64 or darwin64; with --fmi 3 x86_64-linux, aarch64-linux, x86_64-windows, "
            "x86_64-darwin or aarch64-darwin; default: the prebuilt ones, and those for which a compiler is installed",
            (),
            flag="platform",
            metavar="NAME",
        ),
    ]
    flavour: Annotated[
        Build | None,
        Option("default: native; for FILE.py both, if a compiler is installed"),
    ]
    ssp: Annotated[
        Literal["1", "2"] | None,
        Option("of a system: version of SSP; 2 writes an array of an FMU as one connector; default: 1"),
    ]
    studies: Annotated[
        Sequence[str],
        Option(
            "of a system: include the report of a campaign or of `stability` as evidence; `all` includes every report",
            (),
            metavar="CAMPAIGN",
            flag="study",
            completer="campaigns",
        ),
    ]
    output: Annotated[
        FilePath | None,
        Option("write to F; default: NAME.fmu or NAME.ssp here, for FILE.py in build/fmus", metavar="F"),
    ]


EXPORT = Verb(
    "export",
    "build an FMU, or a self-contained .ssp of a system, for a chosen platform",
    (EXPORTED,),
    options=ExportOptions,
    examples={
        "perilune export forming_filter --platform linux64": "forming_filter.fmu",
        "perilune export forming_filter --fmi 3 --output forming_filter_3.fmu": "the same in FMI 3.0",
        "perilune export lunar_terminal_guidance --flavour python "
        "--output landing.ssp": "a system with its FMUs inside",
        "perilune export lunar_terminal_guidance --ssp 2": "the same as SSP 2.0",
        "perilune export lunar_terminal_guidance --as-fmu --slot guidance=analytic_guidance,astar_guidance "
        "--expose plant.position": "the system as one FMU, with a choice of two guidance laws",
    },
)
