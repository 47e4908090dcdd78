"""The C of blocks in FMI 3.0 under the address and undefined-behaviour sanitizers; `make sanitize`: all blocks."""

from __future__ import annotations

from pathlib import Path

import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.native_fmu import native_sources
from tests.support import lengths
from tests.support.kernels.native_instance import GUID
from tests.support.native.driver import drive, link
from tests.support.native.sanitizers import find_compiler

# Vectors, matrices and enumerations; Booleans and Integers in several bundles.
DENSE = ("output_feedback", "command_switch")
BLOCKS = [
    block for block in catalogue().values() if not block.python_only and (lengths.LONG or block.fmu_name in DENSE)
]
STEPS = lengths.size(200)


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: block.fmu_name)
def test_no_sanitizer_objects(block: type[Block], tmp_path: Path) -> None:
    for name, text in native_sources(block, GUID, 3).items():
        (tmp_path / name).write_bytes(text)
    link(find_compiler(), [f"{block.fmu_name}.c"], tmp_path / "driver")
    drive(block, [str(tmp_path / "driver")], GUID, STEPS)
