"""Program that drives an FMU of FMI 3.0, `drive_fmi3.c`: its input for a block, and its output."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

from perilune.fmus_src.block import Block
from perilune.fmus_src.export.description.variables import list_variables
from perilune.fmus_src.export.judge.tunable import tunable_parameters

DRIVER = Path(__file__).with_name("drive_fmi3.c")


def link(command: Sequence[str], inputs: Sequence[str], program: Path) -> None:
    """Make the program with sources or a library of its folder, where the FMI headers are."""
    words = [*command, "-I", ".", "-o", str(program), str(DRIVER), *inputs, "-lm"]
    compiled = subprocess.run(words, cwd=program.parent, capture_output=True, text=True, check=False)
    assert compiled.returncode == 0, compiled.stderr


def drive(block: type[Block], program: Sequence[str], token: str, steps: int) -> str:
    """Return the checksum of ``steps`` steps, none of whose answers is wrong."""
    variables = list_variables(block)
    types = "".join(variable.type_name[0].lower() for variable in variables)
    tunable = tunable_parameters(block)
    causalities = "".join("t" if each.name in tunable else each.declared.causality[0] for each in variables)
    sizes = ",".join(str(variable.size) for variable in variables)
    words = [*program, token, types, causalities, sizes, str(block.default_step), str(steps)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
