"""The C of blocks gives the same bits with every compiler, optimisation and processor.

Truth: a checksum over all variables of a simulation with random inputs, computed here with the system's compiler
without optimisation; it must be equal for x86-64 with and without fused multiply-add, and for aarch64 under qemu. `make
processors` covers every block and every compiler.
"""

from __future__ import annotations

import importlib.util
import shutil
from pathlib import Path

import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.runtime import BlockInstance
from tests.support.kernels.comparison import bits
from tests.support.kernels.elementary_block import ElementaryFunctions
from tests.support.kernels.native_instance import NativeInstance
from tests.support.kernels.programs import COMPILERS, NO_QEMU, QEMU, checksum
from tests.support.lengths import LONG, either

SOME = ("spherical_moon_lander", "free_flying_robot", "kalman_navigation", "entry_capsule")
BLOCKS = [ElementaryFunctions] + [
    block for block in catalogue().values() if not block.python_only and (LONG or block.fmu_name in SOME)
]
QUICK = ("cc -O3 -march=native", "zig aarch64")
STEPS = either(2000, 500)
MANY = either(1_000_000, 20_000)  # steps of the elementary functions
REFERENCE = "cc -O0"

pytestmark = [pytest.mark.slow, pytest.mark.skipif(shutil.which("cc") is None, reason="no system cc")]


@pytest.mark.parametrize("compiler", [name for name in COMPILERS if name != REFERENCE and (LONG or name in QUICK)])
@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: block.fmu_name)
def test_every_compiler_and_processor_gives_the_same_bits(block: type[Block], compiler: str, tmp_path: Path) -> None:
    if compiler.startswith("zig") and importlib.util.find_spec("ziglang") is None:
        pytest.skip("ziglang is not installed")
    if compiler.endswith("aarch64") and QEMU is None:
        pytest.skip(NO_QEMU)
    steps = MANY if block is ElementaryFunctions else STEPS
    expected = checksum(block, REFERENCE, steps, tmp_path)
    assert checksum(block, compiler, steps, tmp_path) == expected


def test_python_and_c_give_the_same_elementary_functions() -> None:
    python, native = BlockInstance(ElementaryFunctions), NativeInstance(ElementaryFunctions)
    references = list(range(sum(variable.size for variable in ElementaryFunctions.variables.values())))
    python.start()
    native.enter()
    native.start()
    for n in range(either(100_000, 3000)):
        python.do_step(float(n), 1.0)
        native.do_step(float(n), 1.0)
        assert bits(python.get(references)) == bits(native.get(references) or [])
    native.free()
