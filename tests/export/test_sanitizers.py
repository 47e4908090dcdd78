"""The C of blocks under the address and undefined-behaviour sanitizers; `make sanitize` covers all, in longer runs."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.judge.tunable import tunable_parameters
from perilune.fmus_src.export.native_fmu import native_sources
from tests.support import kernels, lengths
from tests.support.kernels.native_instance import GUID
from tests.support.lengths import LONG
from tests.support.native.sanitizers import find_compiler

DRIVER = Path(kernels.__file__).with_name("sanitize_fmu.c")
# Those with the most lists, random numbers, searches and vectors between them.
DENSE = ("kalman_navigation", "jet_allocation_least_propellant")
BLOCKS = [block for block in catalogue().values() if not block.python_only and (LONG or block.fmu_name in DENSE)]
STEPS = lengths.size(200)


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: block.fmu_name)
def test_no_sanitizer_objects(block: type[Block], tmp_path: Path) -> None:
    for name, text in native_sources(block, GUID).items():
        (tmp_path / name).write_bytes(text)
    command = [*find_compiler(), "-I", ".", "-o", "driver", str(DRIVER), f"{block.fmu_name}.c", "-lm"]
    compiled = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert compiled.returncode == 0, compiled.stderr
    variables, tunable = block.variables.values(), tunable_parameters(block)
    kinds = "".join(variable.type_name[0].lower() * variable.size for variable in variables)
    causalities = "".join(("t" if each.name in tunable else each.causality[0]) * each.size for each in variables)
    arguments = [GUID, kinds, causalities, str(block.default_step), str(STEPS)]
    done = subprocess.run([str(tmp_path / "driver"), *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
