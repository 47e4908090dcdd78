"""Communication steps that contain several sample instants of a block, in every form of the block.

Truth: FMPy stepping the same FMU by the sample period, with the inputs held over the long step. `make long` covers
every sampled block and flavour, `make test` every twentieth.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from perilune.common.paths import CACHE, shipped_fmu
from perilune.fmus_src.block import Block, Input, Output, Parameter
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.evidence.check import elements_of, read_check
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu
from perilune.fmus_src.runtime import BlockInstance, StepError
from tests.support.kernels.native_instance import ERROR, OK, NativeInstance
from tests.support.lengths import either
from tests.support.native.building import fmi3_fmu
from tests.support.native.flights import Flown, fly_fmi2, fly_fmi3

RATIO = 2.5  # periods in a long step, which holds 2 or 3 instants in turn
LONG_STEPS = 6
TICK = 3  # its word in the serialised state; the time after it is rounded otherwise by 2 steps than by 5
SAMPLED = [block for block in catalogue().values() if "sample_period" in block.variables]
FORMS = [
    (block, form)
    for number, block in enumerate(SAMPLED)
    for shift, form in enumerate(("native", "python", "fmi3"))
    if not (block.python_only and form != "python") and (number + 2 * shift) % either(1, 20) == 0
]


def fly(block: type[Block], form: str, arguments: tuple[Any, ...], folder: Path) -> Flown:
    """Simulate one form of a block by FMPy."""
    if form != "fmi3":
        return fly_fmi2(shipped_fmu(block.fmu_name, form), *arguments, folder)
    if local_platform(3) is None:
        pytest.skip("FMI 3.0 libraries are not compiled for this system")
    return fly_fmi3(fmi3_fmu(block), *arguments, folder)


def counts_and_values(state: bytes, form: str) -> tuple[int, Any]:
    """Return the number of samples that a state has taken, and the bits of all of its variables."""
    if form == "python":
        known = json.loads(state)
        return known["life_cycle"][-1], repr(known["values"])
    return int.from_bytes(state[8 * TICK : 8 * TICK + 8], "little"), state[48:]


def settings_of(block: type[Block]) -> tuple[Mapping[str, float], list[dict[str, float]], float]:
    """Return parameters and inputs of a block's check, and a sample period, which is set with them."""
    check = read_check(block)
    assert check is not None
    rows = csv.DictReader(io.StringIO(check.table.decode()))
    known = elements_of(block)
    inputs = [{name: float(text) for name, text in row.items() if isinstance(known.get(name), Input)} for row in rows]
    declared = block.variables["sample_period"]
    period = float(check.parameters.get("sample_period", declared.elements[0])) or check.step
    return {**check.parameters, "sample_period": period}, inputs, period


@pytest.mark.parametrize(("block", "form"), FORMS, ids=lambda part: getattr(part, "fmu_name", part))
@pytest.mark.usefixtures("fmus")
def test_a_long_step_has_the_bits_of_steps_by_the_period(block: type[Block], form: str, tmp_path: Path) -> None:
    parameters, inputs, period = settings_of(block)
    coarse = [inputs[k % len(inputs)] for k in range(LONG_STEPS)]
    samples = int(RATIO * LONG_STEPS)
    fine = [coarse[math.ceil((j + 1) / RATIO) - 1] for j in range(samples)]
    long = fly(block, form, (parameters, [*coarse, coarse[-1]], RATIO * period), tmp_path / "long")
    short = fly(block, form, (parameters, [*fine, fine[-1]], period), tmp_path / "short")
    for k in range(LONG_STEPS + 1):
        assert repr(long.points[k]) == repr(short.points[int(RATIO * k)]), k
    assert counts_and_values(long.state, form) == counts_and_values(short.state, form)
    assert counts_and_values(long.state, form)[0] == samples


class Counted(Block):
    """Counts samples, and notes the time and the length of the last one."""

    sample_period = Parameter(0.25, unit="s", description="time between samples", minimum=0.0)
    u = Input(0.0, description="held over a step")
    count = Output(0, description="samples")
    begin = Output(0.0, unit="s", description="of the last sample's step")
    length = Output(0.0, unit="s", description="of the last sample's step")
    total = Output(0.0, description="sum of the inputs at the samples")

    def step(self, t: float, h: float) -> None:
        self.count = self.count + 1
        self.begin = t
        self.length = h
        self.total = self.total + self.u


@pytest.fixture
def counted(tmp_path: Path) -> tuple[BlockInstance, NativeInstance]:
    """Return the block in Python and in C, started at 100 s."""
    component = BlockInstance(Counted)
    component.start_time = 100.0
    component.start()
    native = NativeInstance(Counted)
    native.enter(100.0)
    assert native.start() == OK
    return component, native


def read(native: NativeInstance) -> list:
    """Return all values of the block in C."""
    values = native.get(list(range(6)))
    assert values is not None
    return values


def test_one_instant_has_the_importers_step_and_several_have_the_periods(counted: Any) -> None:
    """Closed form: instants at 100 + k / 4, all of it exact in binary."""
    component, native = counted
    for begin, end, last in (
        (100.0, 100.125, (0, 0.0, 0.0)),
        (100.125, 100.375, (1, 100.125, 0.25)),
        (100.375, 100.75, (3, 100.5, 0.25)),
        (100.75, 160.0, (240, 159.75, 0.25)),
        (160.0, 160.4375, (241, 160.0, 0.4375)),
    ):
        component.do_step(begin, end - begin)
        assert native.do_step(begin, end - begin) == OK
        assert component.values() == read(native)
        assert tuple(component.values()[2:5]) == last


def test_instants_that_rounding_puts_past_the_end_are_of_the_step(tmp_path: Path) -> None:
    """A step of 3 x 0.1 s ends at 0.30000000000000004 s, one of 0.3 s before the third instant."""
    component = BlockInstance(Counted)
    component.set([0], [0.1])
    component.start()
    for k, end in enumerate((0.3, 0.6, 0.8999999999999999, 1.2), 1):
        component.do_step(0.3 * (k - 1), end - 0.3 * (k - 1))
        assert component.block.count == 3 * k


def test_a_million_samples_are_taken_and_one_more_is_refused(counted: Any) -> None:
    component, native = counted
    message = (
        "communication step 250000.25 s holds more than 1000000 samples of sample_period 0.25 s; "
        "use a shorter communication step, or a longer period"
    )
    with pytest.raises(StepError) as error:
        component.do_step(100.0, 250000.25)
    assert str(error.value) == message
    assert component.block.count == 0
    state = native.get_state()
    assert native.do_step(100.0, 250000.25) == ERROR
    assert native.log == [f"StepError: {message}"]
    assert native.set_state(state) == OK
    native.free_state(state)
    assert native.do_step(100.0, 250000.0) == OK
    assert read(native)[2:5] == [1_000_000, 250099.75, 0.25]


class Divides(Block):
    """Fails at its third sample."""

    sample_period = Parameter(0.5, unit="s", description="time between samples", minimum=0.0)
    left = Output(3.0, description="samples until it fails")

    def initialize(self) -> None:
        self.left = 3.0

    def step(self, t: float, h: float) -> None:
        self.left = self.left - 1.0
        _ = 1.0 / self.left


def test_a_sample_that_fails_is_named_with_its_step(tmp_path: Path) -> None:
    native = NativeInstance(Divides)
    native.enter()
    assert native.start() == OK
    assert native.do_step(0.0, 60.0) == ERROR
    assert "ZeroDivisionError" in native.log[0]
    assert native.log[0].endswith(", in the step from t = 1.0 s over h = 0.5 s")
    component = BlockInstance(Divides)
    component.start()
    with pytest.raises(ZeroDivisionError):
        component.do_step(0.0, 60.0)
    assert component.tick == 3


def test_an_fmu_of_a_users_block_takes_long_steps(tmp_path: Path) -> None:
    """In FMPy's own loop, at a tenth and at ten times the period: the same counts at the same times."""
    import fmpy

    platform = local_platform()
    assert platform is not None
    path = build_native_fmu(Counted, tmp_path / "counted.fmu", platforms=[platform], cache=CACHE)
    counts = {}
    for step in (0.025, 0.25, 2.5):
        rows = fmpy.simulate_fmu(str(path), stop_time=10.0, step_size=step, output_interval=2.5, output=["count"])
        counts[step] = [(float(row["time"]), int(row["count"])) for row in rows]
    assert counts[0.025] == counts[0.25] == counts[2.5] == [(2.5 * k, 10 * k) for k in range(5)]
