"""FMI functions of the native FMU: life cycle, complete state, and refusal of invalid calls. Truth: FMI 2.0."""

from __future__ import annotations

import ctypes
import math
import threading
from ctypes import byref, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p

import pytest

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.runtime import BlockInstance, StepError
from tests.support.kernels.native_instance import ERROR, GUID, OK, NativeInstance, library

DISCARD = 2


class Walk(Block):
    """Adds its input to its sum at every sample."""

    gain = Parameter(1.0, description="factor")
    sample_period = Parameter(0.0, unit="s", description="sampling")
    x = Input(0.0, description="what to add")
    k = Input(1, description="an int to multiply the product with")
    on = Input(True, description="whether to add")
    total = Output(0.0, direct=True, description="the sum")
    starts = Output(0.0, direct=True, description="the input at the start")
    product = Output(1, direct=True, description="grows beyond 32 bits")
    samples = State(0, description="samples taken")
    start_time = State(0.0, unit="s", description="start of the flight")

    def initialize(self) -> None:
        self.starts = self.gain * self.x

    def step(self, t: float, h: float) -> None:
        if self.on:
            self.total = self.total + self.gain * self.x
        self.product = self.product * self.k
        self.samples = self.samples + 1


class Unlike(Block):
    """Has one variable."""

    y = Output(0.0, description="nothing")

    def step(self, t: float, h: float) -> None:
        self.y = 0.0


NAMES = list(Walk.variables)
REFERENCE = {name: number for number, name in enumerate(NAMES)}
ALL = list(range(len(NAMES)))


@pytest.fixture
def walk():
    instance = NativeInstance(Walk)
    yield instance
    instance.free()


def set_to(instance: NativeInstance, **values: object) -> int:
    return instance.set([REFERENCE[name] for name in values], list(values.values()))


def value_of(instance: NativeInstance, name: str) -> object:
    values = instance.get([REFERENCE[name]])
    return None if values is None else values[0]


def test_reads_during_initialisation_settle_each_time(walk: NativeInstance) -> None:
    set_to(walk, x=2.0, gain=3.0)
    walk.enter(start_time=5.0)
    assert value_of(walk, "starts") == 6.0
    assert value_of(walk, "start_time") == 5.0
    set_to(walk, x=4.0)
    assert value_of(walk, "starts") == 12.0
    assert walk.start() == OK
    set_to(walk, x=5.0)
    assert value_of(walk, "starts") == 12.0


@pytest.mark.parametrize(
    ("period", "step", "start"), [(0.3, 0.1, 0.0), (0.1, 0.1, 7.3), (1e-3, 1e-3, 1e6), (0.25, 0.1, 0.0)]
)
def test_sample_instants_are_those_of_python(walk: NativeInstance, period: float, step: float, start: float) -> None:
    plain = BlockInstance(Walk)
    plain.start_time = start
    plain.set([REFERENCE["sample_period"], REFERENCE["x"]], [period, 1.0])
    set_to(walk, sample_period=period, x=1.0)
    walk.enter(start)
    plain.start()
    assert walk.start() == OK
    for n in range(3000):
        assert walk.do_step(start + n * step, step) == OK
        plain.do_step(start + n * step, step)
        assert walk.get(ALL) == plain.get(ALL)
    assert walk.get_state().value


@pytest.mark.parametrize(
    ("h", "period"), [(0.1, 5e-8), (1e-7, 1e-15), (123456789.125, 0.1), (1e22, 2e15), (0.7, 1 / 3e7)]
)
def test_step_of_too_many_periods_is_refused_in_pythons_words(walk: NativeInstance, h: float, period: float) -> None:
    plain = BlockInstance(Walk)
    plain.set([REFERENCE["sample_period"]], [period])
    set_to(walk, sample_period=period)
    walk.enter()
    walk.start()
    plain.start()
    with pytest.raises(StepError) as caught:
        plain.do_step(0.0, h)
    assert walk.do_step(0.0, h) == ERROR
    assert walk.log == [f"StepError: {caught.value}"]


def test_state_is_complete_and_restored(walk: NativeInstance) -> None:
    set_to(walk, x=1.5)
    walk.enter()
    walk.start()
    walk.do_step(0.0, 0.1)
    state = walk.get_state()
    text = walk.serialised(state)
    before = walk.get(ALL)
    for n in range(5):
        walk.do_step(0.1 * (n + 1), 0.1)
    after = walk.get(ALL)
    assert after != before
    other = NativeInstance(Walk)
    for instance, saved in ((walk, state), (walk, walk.deserialised(text)), (other, other.deserialised(text))):
        assert instance.set_state(saved) == OK
        assert instance.get(ALL) == before
        for n in range(5):
            assert instance.do_step(0.1 * (n + 1), 0.1) == OK
        assert instance.get(ALL) == after
        instance.free_state(saved)
    other.free()


def test_state_saved_before_settling_settles_after_restoring(walk: NativeInstance) -> None:
    walk.enter()
    set_to(walk, x=2.0)
    state = walk.get_state()
    assert value_of(walk, "starts") == 2.0
    assert walk.set_state(state) == OK
    set_to(walk, x=3.0)
    assert value_of(walk, "starts") == 3.0
    walk.free_state(state)


def test_serialised_state_is_a_function_of_the_state(walk: NativeInstance) -> None:
    walk.enter()
    walk.start()
    first, second = walk.get_state(), walk.get_state()
    text = walk.serialised(first)
    assert text == walk.serialised(second)
    words = memoryview(text).cast("q")
    assert len(words) == 6 + len(NAMES)
    values = memoryview(text).cast("d")
    assert values[6 + REFERENCE["gain"]] == 1.0
    assert words[6 + REFERENCE["on"]] == 1
    for state in (first, second):
        walk.free_state(state)


def test_foreign_states_are_refused(walk: NativeInstance) -> None:
    state = walk.get_state()
    text = walk.serialised(state)
    place = c_void_p()
    for wrong in (text[:-1], text + b"\0" * 8, b"\0" * len(text), text[:8] + b"\7" + text[9:]):
        assert walk.call("fmi2DeSerializeFMUstate", wrong, c_size_t(len(wrong)), byref(place)) == ERROR
        assert place.value is None
    assert walk.call("fmi2SetFMUstate", None) == ERROR
    small = (ctypes.c_char * 8)()
    assert walk.call("fmi2SerializeFMUstate", state, small, c_size_t(8)) == ERROR
    walk.free_state(state)


def test_a_state_is_not_saved_into_one_of_another_fmu_which_has_other_room(walk: NativeInstance) -> None:
    """Walk's state would be written beyond the end of the smaller FMU's."""
    other = NativeInstance(Unlike, dll=library(Unlike, "{other}"), guid="{other}")
    theirs, ours = other.get_state(), walk.get_state()
    before, text = other.serialised(theirs), walk.serialised(ours)
    assert walk.call("fmi2GetFMUstate", byref(theirs)) == ERROR
    assert walk.log[-1].startswith("fmi2GetFMUstate: FMUstate is one of another FMU")
    assert walk.call("fmi2DeSerializeFMUstate", text, c_size_t(len(text)), byref(theirs)) == ERROR
    assert walk.log[-1].startswith("fmi2DeSerializeFMUstate: FMUstate is one of another FMU")
    assert other.serialised(theirs) == before
    assert walk.call("fmi2GetFMUstate", byref(ours)) == OK  # into a separate state
    walk.free_state(ours)
    other.free_state(theirs)
    other.free()


def test_error_ends_the_run_until_state_or_reset(walk: NativeInstance) -> None:
    walk.enter()
    walk.start()
    state = walk.get_state()
    set_to(walk, k=2**16)
    assert walk.do_step(0.0, 0.1) == OK
    assert walk.do_step(0.1, 0.1) == OK
    assert value_of(walk, "product") is None
    assert "product = 4294967296 exceeds an FMI Integer's 32 bits" in walk.log[-1]
    assert walk.do_step(0.2, 0.1) == ERROR
    assert "not allowed after an error" in walk.log[-1]
    assert walk.set_state(state) == OK
    for n in range(3):
        set_to(walk, k=2**31 - 1)
        assert walk.do_step(0.1 * n, 0.1) == (OK if n < 2 else ERROR)
    assert "OverflowError: int beyond 64 bits, in the step from t = 0.2 s over h = 0.1 s" in walk.log[-1]
    assert value_of(walk, "samples") == 2
    walk.reset()
    walk.enter()
    assert value_of(walk, "product") == 1
    walk.free_state(state)


def test_wrong_references_and_types_are_refused(walk: NativeInstance) -> None:
    walk.enter()
    one = c_size_t(1)
    real, whole = (c_double * 1)(), (c_int * 1)()
    for reference, message in ((99, "no variable with value reference 99"), (REFERENCE["k"], "k is of type Integer")):
        assert walk.call("fmi2GetReal", (c_uint * 1)(reference), one, real) == ERROR
        assert message in walk.log[-1]
        assert walk.call("fmi2SetReal", (c_uint * 1)(reference), one, real) == ERROR
    assert walk.call("fmi2SetInteger", (c_uint * 1)(REFERENCE["on"]), one, whole) == ERROR
    assert walk.call("fmi2SetBoolean", (c_uint * 1)(REFERENCE["x"]), one, whole) == ERROR
    assert walk.call("fmi2GetReal", None, one, real) == ERROR
    assert walk.call("fmi2GetReal", (c_uint * 1)(0), one, None) == ERROR
    assert walk.call("fmi2GetReal", None, c_size_t(0), None) == OK
    assert walk.call("fmi2GetString", (c_uint * 1)(0), one, None) == ERROR
    assert set_to(walk, total=1.0) == ERROR
    assert "total is computed and cannot be set" in walk.log[-1]
    walk.start()
    assert set_to(walk, gain=2.0) == ERROR
    assert "gain is a parameter, fixed after initialisation" in walk.log[-1]


@pytest.mark.parametrize("wrong", ["gain", "total", "k", "nothing"])
def test_a_wrong_reference_leaves_the_right_ones_unset(walk: NativeInstance, wrong: str) -> None:
    walk.enter()
    walk.start()
    before = walk.get(ALL)
    references = (c_uint * 2)(REFERENCE["x"], REFERENCE.get(wrong, 2**32 - 1))
    assert walk.call("fmi2SetReal", references, c_size_t(2), (c_double * 2)(5.0, 6.0)) == ERROR
    assert walk.get(ALL) == before


def test_calls_out_of_order_are_refused(walk: NativeInstance) -> None:
    assert walk.do_step(0.0, 0.1) == ERROR
    assert walk.start() == ERROR
    assert walk.get([0]) is None
    walk.enter()
    assert walk.call("fmi2EnterInitializationMode") == ERROR
    assert walk.call("fmi2Terminate") == ERROR
    walk.start()
    for h in (0.0, -0.1, math.nan, math.inf):
        assert walk.do_step(0.0, h) == ERROR
    assert walk.do_step(0.0, 0.1) == OK
    assert walk.call("fmi2Terminate") == OK
    assert walk.do_step(0.1, 0.1) == ERROR
    assert walk.call("fmi2Terminate") == ERROR
    assert value_of(walk, "samples") == 1


def test_steps_begin_where_the_last_one_ended(walk: NativeInstance) -> None:
    walk.enter()
    walk.start()
    for n in range(3):
        assert walk.do_step(0.1 * n, 0.1) == OK
    state = walk.get_state()
    for wrong in (0.0, 0.2, 0.4, 0.3002, 1e9, -0.3):
        assert walk.do_step(wrong, 0.1) == ERROR
        assert f"the step begins at {wrong!r} s, and the FMU is at 0.30000000000000004 s" in walk.log[-1]
    assert walk.do_step(0.3 + 1e-12, 0.1) == OK
    assert walk.set_state(state) == OK
    assert walk.do_step(0.3, 0.1) == OK
    assert value_of(walk, "samples") == 4
    walk.free_state(state)


def test_status_functions(walk: NativeInstance) -> None:
    walk.enter(2.0)
    walk.start()
    walk.do_step(2.0, 0.5)
    status, time, flag = c_int(), c_double(), c_int(7)
    assert (walk.call("fmi2GetStatus", 0, byref(status)), status.value) == (OK, OK)
    assert (walk.call("fmi2GetRealStatus", 2, byref(time)), time.value) == (OK, 2.5)
    assert (walk.call("fmi2GetBooleanStatus", 3, byref(flag)), flag.value) == (OK, 0)
    assert walk.call("fmi2GetIntegerStatus", 0, byref(flag)) == DISCARD
    assert walk.call("fmi2GetStringStatus", 1, byref(c_char_p())) == DISCARD
    for function in ("fmi2CancelStep", "fmi2GetDirectionalDerivative", "fmi2SetRealInputDerivatives"):
        assert walk.call(function, *[None] * 6) == ERROR


def test_null_instance_is_an_error() -> None:
    dll = library(Walk)
    for function in ("fmi2DoStep", "fmi2GetReal", "fmi2Reset", "fmi2GetFMUstate", "fmi2Terminate", "fmi2CancelStep"):
        assert getattr(dll, function)(None, None, None, None) == ERROR
    dll.fmi2FreeInstance(None)


def test_instantiation_refuses_wrong_arguments() -> None:
    for guid, name in (("{wrong}", "a"), (GUID, "")):
        instance = NativeInstance(Walk, guid=guid, name=name)
        assert not instance.handle
        assert len(instance.log) == 1
    assert not library(Walk).fmi2Instantiate(b"a", 1, GUID.encode(), None, None, 0, 0)


def test_instances_in_threads_do_not_disturb_one_another() -> None:
    block = catalogue()["noisy_navigation"]
    results: dict[int, list] = {}

    def run(number: int, key: int) -> None:
        instance = NativeInstance(block)
        names = [name for name, variable in block.variables.items() for _ in range(variable.size)]
        instance.set([names.index("seed")], [number])
        instance.enter()
        instance.start()
        for n in range(200):
            instance.do_step(0.1 * n, 0.1)
        results[key] = instance.get(list(range(len(names)))) or []
        instance.free()

    threads = [threading.Thread(target=run, args=(number % 4, number)) for number in range(16)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number in range(4):
        assert all(results[number + 4 * k] == results[number] for k in range(4))
    assert len({str(results[number]) for number in range(4)}) == 4
