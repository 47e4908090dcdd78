"""The verbs that make something to work with: new block, new system, export."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Literal, TypedDict

from .option import FilePath, Option
from .verb import Argument, Verb

NAME = Argument("name", "NAME", "small letters, digits and underscores")

NEW_BLOCK = Verb(
    "new block",
    "write NAME.py, a block of your own to start from",
    (
        NAME,
        Argument(
            "slot",
            "SLOT",
            "the slot that it fits into, one of `perilune describe SLOT`; default: a plain block",
            "block_slots",
            optional=True,
            is_option=True,
        ),
    ),
    module="new",
    function="new_block",
    examples={
        "perilune new block my_guidance --slot terminal_guidance": "my_guidance.py, which runs as it is",
    },
)

NEW_SYSTEM = Verb(
    "new system",
    "write the folder NAME, a system of your own to start from: blocks, parameter sets, campaign",
    (NAME,),
    module="new",
    function="new_system",
    examples={
        "perilune new system my_axis": "a folder with plant, controller, description, campaign, loop",
    },
)


class ExportOptions(TypedDict, total=False):
    """Options of export"""

    platforms: Annotated[
        Sequence[Literal["linux64", "win64", "darwin64"]],
        Option("of native FMUs; default: those that come built, or that a compiler here serves", (), flag="platform"),
    ]
    flavour: Annotated[
        Literal["native", "python"] | None,
        Option("default: native; of FILE.py both, as far as a compiler is here"),
    ]
    output: Annotated[
        FilePath | None,
        Option("write to F; default: NAME.fmu or NAME.ssp here, of FILE.py in build/fmus", metavar="F"),
    ]


EXPORT = Verb(
    "export",
    "build an FMU, or a self-contained .ssp of a system, for a chosen platform",
    (
        Argument(
            "name",
            "SYSTEM|FMU|BLOCK|FILE.py",
            "a system or its folder, a block's name (of a .py file in this folder, too), or a file with blocks",
            "systems_and_fmus",
        ),
    ),
    options=ExportOptions,
    examples={
        "perilune export forming_filter --platform linux64": "forming_filter.fmu",
        "perilune export lunar_terminal_guidance --flavour python "
        "--output landing.ssp": "a system with its FMUs inside",
    },
)
