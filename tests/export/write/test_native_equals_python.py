"""Every block of the catalogue: plain Python and compiled C agree to the last bit, faults included.

`make test` covers every third block with random inputs and every ninth with extreme inputs.
"""

from __future__ import annotations

import pytest

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from tests.support import lengths
from tests.support.kernels.comparison import Pair, fly, only_switches
from tests.support.lengths import either

BLOCKS = [block for block in catalogue().values() if not block.python_only]
DEAR = ("convex_guidance",)  # which plans in most steps
STEPS = lengths.size(400)  # in addition to the 1000 of test_three_faces.py


@pytest.mark.parametrize("block", BLOCKS[:: either(1, 3)], ids=lambda block: block.fmu_name)
def test_bitwise_equal_over_random_inputs(block: type[Block]) -> None:
    pair = Pair(block, lengths.generator(block.fmu_name))
    steps = STEPS // either(1, 4) if block.fmu_name in DEAR else STEPS
    rows, flights = fly(pair, steps)
    pair.native.free()
    assert only_switches(block) or len(set(rows)) > 0.3 * steps, (
        "most rows repeat earlier ones: the comparison says little"
    )
    assert len(pair.faults) < 0.5 * flights, f"most flights end in a fault: {pair.faults[0]}"


@pytest.mark.parametrize("block", BLOCKS[either(0, 1) :: either(1, 9)], ids=lambda block: block.fmu_name)
def test_faults_equal_over_wild_inputs(block: type[Block]) -> None:
    pair = Pair(block, lengths.generator(f"{block.fmu_name} wild"))
    pair.wild = True
    fly(pair, lengths.size(200))
    pair.native.free()
