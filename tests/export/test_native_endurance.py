"""Native instances over many resets and in many threads: constant memory and constant bits."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from perilune.fmus_src.block import Block, Input
from perilune.fmus_src.catalogue import catalogue
from tests.support import lengths
from tests.support.kernels.comparison import draw, elements
from tests.support.kernels.native_instance import OK, NativeInstance
from tests.support.lengths import either

BLOCKS = [block for block in catalogue().values() if not block.python_only]
STATM = Path("/proc/self/statm")
CYCLES = 10_000
PAGE = 4096
# A leaked instance, or state, of this block has more than 600 bytes: 9000 of them would be 5 MB.
FLAT = 1_000_000


def flight(instance: NativeInstance, block: type[Block], key: str, steps: int) -> list[bytes]:
    """Return the complete states at the start and after each step of a flight whose inputs ``key`` determines."""
    random = lengths.generator(f"{block.fmu_name} {key}")
    inputs = [n for n, (variable, _) in enumerate(elements(block)) if isinstance(variable, Input)]
    h = block.default_step
    instance.enter()
    assert instance.start() == OK
    states = [state_of(instance)]
    for n in range(steps):
        values = [draw(random, *elements(block)[reference], h) for reference in inputs]
        assert instance.set(inputs, values) == OK
        if instance.do_step(n * h, h) != OK:
            break
        states.append(state_of(instance))
    return states


def state_of(instance: NativeInstance) -> bytes:
    state = instance.get_state()
    text = instance.serialised(state)
    instance.free_state(state)
    return text


@pytest.mark.skipif(not STATM.exists(), reason="reads the size of the process where Linux has it")
def test_memory_is_flat_over_resets() -> None:
    instance = NativeInstance(catalogue()["noisy_navigation"])
    sizes = []
    for cycle in range(CYCLES):
        instance.reset()
        instance.enter()
        assert instance.start() == OK
        assert instance.do_step(0.0, 0.1) == OK
        state = instance.get_state()
        copy = instance.deserialised(instance.serialised(state))
        assert instance.set_state(copy) == OK
        instance.free_state(state)
        instance.free_state(copy)
        if cycle % 1000 == 999:
            sizes.append(int(STATM.read_text().split()[1]) * PAGE)
    instance.free()
    assert sizes[-1] - sizes[0] < FLAT, sizes


@pytest.mark.parametrize("block", BLOCKS[:: either(1, 12)], ids=lambda block: block.fmu_name)
def test_after_reset_an_instance_is_as_new(block: type[Block]) -> None:
    fresh, used = NativeInstance(block), NativeInstance(block)
    new = state_of(fresh)
    flown = flight(fresh, block, "a", 50)
    for key in ("b", "c", "a"):
        used.reset()
        assert state_of(used) == new
        last = flight(used, block, key, 50)
    assert last == flown
    assert len(set(flown)) > 1
    fresh.free()
    used.free()


@pytest.mark.parametrize("block", BLOCKS[:: either(1, 20)], ids=lambda block: block.fmu_name)
def test_flights_in_threads_have_the_bits_of_flights_in_turn(block: type[Block]) -> None:
    def fly(key: int) -> list[bytes]:
        instance = NativeInstance(block)
        states = flight(instance, block, str(key), 100)
        instance.free()
        return states

    fly(0)  # compiled before the threads begin: CPython 3.11 cannot parse in several threads at once
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)  # change threads as often as possible
    try:
        with ThreadPoolExecutor(8) as pool:
            together = list(pool.map(fly, range(8)))
    finally:
        sys.setswitchinterval(interval)
    assert together == [fly(key) for key in range(8)]
