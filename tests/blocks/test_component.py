"""The life cycle of a component (`perilune.fmus_src.runtime.Component`) against the FMI co-simulation rules.

Truth: blocks written here whose behaviour is known by construction (accumulators, logs of their calls),
exact fractions for sample instants, and real blocks compared with themselves: a repeated initialisation
and a restored state must repeat every value to the last bit.
"""

import copy
import pickle
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.disturbances.forming_filter import FormingFilter
from perilune.fmus_src.guidance.analytic import AnalyticGuidance
from perilune.fmus_src.interfaces.network_operator_law import NetworkOperatorLaw
from perilune.fmus_src.mathlib.rng import seed_streams, uniform
from perilune.fmus_src.mathlib.vectors import Vector3, vector
from perilune.fmus_src.navigation.noisy import NoisyNavigation
from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander
from perilune.fmus_src.plants.free_flying_robot import FreeFlyingRobot
from perilune.fmus_src.runtime import Component, StepError


class Probe(Block):
    """Counts its initialisations and draws random numbers; outputs depend on what was set."""

    gain = Parameter(2.0, unit="1", description="factor")
    level = Input([1.0, 10.0], unit="1", description="two inputs")
    scaled = Output([0.0, 0.0], unit="1", direct=True, description="gain times level, added up over settlings")
    number = Output(0.0, unit="1", description="a random number")
    generator = State([0.0] * 6, description="random number generator")
    runs = State(0, description="initialisations since the last reset")
    on = State(False, description="set by initialisation")

    def initialize(self) -> None:
        seed_streams(self.generator, 1, 2)
        self.runs = self.runs + 1
        self.on = True
        self.scaled = self.scaled + self.gain * self.level
        self.number = self.number + uniform(self.generator)

    def step(self, t: float, h: float) -> None:
        self.scaled = self.gain * self.level
        self.number = uniform(self.generator)


class Sampler(Block):
    """Counts its steps and notes their times."""

    sample_period = Parameter(0.0, unit="s", description="time between samples")
    steps = Output(0, description="steps taken")
    last = Output(0.0, unit="s", description="end of the last step")

    def step(self, t: float, h: float) -> None:
        self.steps = self.steps + 1
        self.last = t + h


def reference(component, name, element=0):
    """Value reference of an element: variables in order of declaration, elements numbered through."""
    position = 0
    for variable_name, variable in type(component.block).variables.items():
        if variable_name == name:
            return position + element
        position += variable.size
    raise KeyError(name)


def references(component, *names):
    found: list[int] = []
    for name in names:
        first = reference(component, name)
        found += range(first, first + type(component.block).variables[name].size)
    return found


def everything(component):
    count = sum(variable.size for variable in type(component.block).variables.values())
    return component.get(list(range(count)))


def test_value_references_number_the_elements_in_order_of_declaration():
    component = Component(Probe)
    assert references(component, "gain", "level", "scaled", "number") == [0, 1, 2, 3, 4, 5]
    component.set([0, 2], [3.0, 7.0])
    assert component.block.gain == 3.0
    assert component.block.level == [1.0, 7.0]
    assert component.get([2, 0, 1]) == [7.0, 3.0, 1.0]


def test_a_read_settles_an_instance_that_was_set():
    component = Component(Probe)
    assert component.get([3, 4]) == [2.0, 20.0]
    component.set([0], [5.0])
    component.set([1], [4.0])
    assert component.get([3, 4]) == [20.0, 50.0]  # not added to the first settling
    assert component.get([reference(component, "runs")]) == [1]


def test_reads_without_a_change_do_not_settle_again():
    component = Component(Probe)
    component.get([3])
    component.block.scaled = [-1.0, 20.0]  # a second settling would overwrite this
    assert component.get([3]) == [-1.0]


def test_start_settles_once_and_ends_initialisation():
    component = Component(Probe)
    component.set([1], [4.0])
    component.start()
    assert component.block.scaled == [8.0, 20.0]
    component.set([1], [100.0])
    assert component.get([3]) == [8.0]  # after initialisation a set value waits for the next step
    component.do_step(0.0, 0.1)
    assert component.get([3]) == [200.0]


def test_lists_keep_their_identity_through_settling_restoring_and_assignment():
    component = Component(Probe)
    generator = component.block.generator
    component.start()
    component.set_state(component.get_state())
    component.block.generator = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert component.block.generator is generator
    assert generator == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


def test_elements_are_got_and_set_in_any_order_and_number():
    component = Component(Probe)
    component.start()
    count = len(component.elements)
    component.write(list(range(count)), [float(k) for k in range(count)])
    for chosen in ([2, 1], [0, 2, 3], [8, 7, 6], [1, 2, 1], [4, 5, 6, 7, 8, 9, 10, 11], []):
        assert component.get(chosen) == [float(k) for k in chosen]
    component.set([2, 1, 9], [-2.0, -1.0, -9.0])
    assert component.block.level == [-1.0, -2.0]
    assert component.get([9, 10, 1]) == [-9.0, 10.0, -1.0]
    for bad in ([-1], [count]):
        with pytest.raises(IndexError):
            component.get(bad)
    with pytest.raises(ValueError, match="2 values for 1 value references"):
        component.set([1], [1.0, 2.0])


class Storing(Block):
    """Stores what a library gives, as only Python can."""

    python_only = True
    given = Input([0.0, 0.0, 0.0], description="three numbers")
    kept = Output([0.0, 0.0, 0.0], direct=True, description="the same, of any type")
    longer = Output([0.0] * 5, direct=True, description="a list")
    count = State([0, 0], description="ints")

    def step(self, t: float, h: float) -> None:
        self.before = self.kept
        self.kept = np.array(self.given) + 1.0
        self.longer = np.arange(5) * t
        self.count = (1, np.int64(2))


def test_python_only_blocks_store_any_sequence_and_outputs_stay_connected():
    """What used to cut an output off: a list of a library in place of the declared one."""
    component = Component(Storing)
    component.start()
    for n in range(3):
        component.set([0, 1, 2], [n, 2.0 * n, 3.0])
        component.do_step(float(n), 1.0)
        assert component.get(list(range(3, 13))) == [
            n + 1.0,
            2.0 * n + 1.0,
            4.0,
            *(k * float(n) for k in range(5)),
            1,
            2,
        ]
        assert type(component.block.kept) is Vector3
        assert all(type(x) is float for x in component.get(list(range(3, 11))))
    assert component.block.before == [2.0, 3.0, 4.0]  # a vector kept before a step is what it was


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("kept", [1.0, 2.0], r"storing\.kept: give a list of 3, or another sequence; got \[1\.0, 2\.0\]"),
        ("kept", 5.0, r"storing\.kept: give a list of 3"),
        ("kept", vector(1.0, 2.0), r"storing\.kept: give a list of 3"),
        ("kept", ["up", "down", "left"], r"storing\.kept: its elements are of type Real"),
        ("longer", [0.0] * 6, r"storing\.longer: give a list of 5"),
        ("count", [1.5, 2], r"storing\.count: its elements are of type Integer"),
    ],
)
def test_what_does_not_fit_is_refused_with_block_and_variable(name, value, message):
    block = Storing()
    with pytest.raises(TypeError, match=message):
        setattr(block, name, value)
    with pytest.raises(TypeError, match="give a list of 3"):
        Storing(given=[1.0])


def test_instances_do_not_share_their_starts():
    one, other = Storing(), Storing()
    one.kept = [1.0, 2.0, 3.0]
    one.longer[0] = 7.0
    assert other.kept == [0.0, 0.0, 0.0]
    assert other.longer == [0.0] * 5


def test_which_variables_are_vectors():
    variables = FreeFlyingRobot.variables
    assert {name for name, each in variables.items() if each.is_vector} == {
        name
        for name, each in variables.items()
        if isinstance(each.start, list) and each.type_name == "Real" and each.size <= 4
    }
    assert not NetworkOperatorLaw.variables["matrix"].is_vector
    assert not State([1, 2], description="ints").is_vector
    assert not State([1.0] * 4, columns=2, description="a matrix").is_vector
    assert not State([1.0] * 4, vector=False, description="a list").is_vector
    assert not State([1.0], description="one element").is_vector


def test_repeated_initialisation_repeats_the_random_stream():
    once, often = Component(Probe), Component(Probe)
    for value in (3.0, 4.0, 5.0):
        often.set([0], [value])
        everything(often)
    once.set([0], [5.0])
    once.start()
    often.start()
    for k in range(5):
        assert everything(often) == everything(once)
        once.do_step(0.1 * k, 0.1)
        often.do_step(0.1 * k, 0.1)


@pytest.mark.parametrize("block_class", [NoisyNavigation, FormingFilter])
def test_repeated_initialisation_of_random_blocks_equals_one(block_class):
    once, often = Component(block_class), Component(block_class)
    seed = reference(once, "seed")
    for value in (9, 1, 4):
        often.set([seed], [value])
        everything(often)
    once.set([seed], [4])
    once.start()
    often.start()
    for k in range(20):
        once.do_step(0.2 * k, 0.2)
        often.do_step(0.2 * k, 0.2)
        assert everything(often) == everything(once)


@pytest.mark.parametrize("name", sorted(catalogue()))
def test_every_block_initialises_from_its_declared_starts(name):
    """Importers call initialisation with nothing set; it repeats to the last bit."""
    component = Component(catalogue()[name])
    first = everything(component)
    component.unsettled = True
    assert everything(component) == first
    component.start()


@pytest.mark.parametrize(
    ("period", "step"),
    [
        ("0.1", "0.1"),
        ("0.1", "0.05"),
        ("0.3", "0.1"),
        ("0.7", "0.1"),
        ("0.007", "0.001"),
        ("0.25", "0.1"),
        ("1.1", "0.3"),
        ("0.2", "1/30"),
        ("1/3", "1/12"),
        ("1/3", "1/3"),
        ("0.1", "0.099"),
    ],
)
@pytest.mark.parametrize("start", [0.0, 1234.567, -5.5, 1e5])
def test_samples_fall_on_the_first_communication_point_at_or_after_each_tick(period, step, start):
    """Exact fractions say where; communication points are start + n h in floating point."""
    exact = Fraction(period) / Fraction(step)
    h = float(Fraction(step))
    component = Component(Sampler)
    component.set([0], [float(Fraction(period))])
    component.start_time = start
    component.start()
    for n in range(2000):
        component.do_step(start + n * h, h)
        ticks = (n + 1) / exact  # whole ticks reached at the end of the step
        assert component.block.steps == ticks.numerator // ticks.denominator


@given(st.integers(1, 400), st.integers(1, 400), st.integers(0, 10**6))
@settings(max_examples=60, deadline=None)
def test_no_sample_is_lost_or_doubled_for_any_period(step_thousandths, more_thousandths, start_thousandths):
    exact = Fraction(step_thousandths + more_thousandths, step_thousandths)
    h, start = step_thousandths / 1000.0, start_thousandths / 1000.0
    component = Component(Sampler)
    component.set([0], [(step_thousandths + more_thousandths) / 1000.0])
    component.start_time = start
    component.start()
    for n in range(300):
        component.do_step(start + n * h, h)
        assert component.block.steps == ((n + 1) / exact).__floor__()


def test_sample_period_of_zero_steps_at_every_communication_point():
    component = Component(Sampler)
    component.start()
    for n in range(10):
        component.do_step(0.1 * n, 0.1)
    assert component.get([1]) == [10]


def test_blocks_without_a_sample_period_step_always():
    component = Component(Probe)
    component.start()
    for n in range(3):
        before = component.get([5])
        component.do_step(0.1 * n, 0.1)
        assert component.get([5]) != before


def test_outputs_hold_between_samples():
    component = Component(Sampler)
    component.set([0], [0.5])
    component.start()
    lasts = []
    for n in range(10):
        component.do_step(0.125 * n, 0.125)
        lasts.append(component.block.last)
    assert lasts == [0.0] * 3 + [0.5] * 4 + [1.0] * 3


@pytest.mark.parametrize("step", [0.2, 0.21, 1.0])
def test_two_samples_in_one_step_are_refused(step):
    component = Component(Sampler)
    component.set([0], [0.1])
    component.start()
    with pytest.raises(StepError, match=r"sample_period 0\.1 s"):
        component.do_step(0.0, step)
    assert component.block.steps == 0  # nothing was stepped


def test_a_step_of_almost_two_periods_that_holds_one_sample_is_taken():
    component = Component(Sampler)
    component.set([0], [0.1])
    component.start()
    component.do_step(0.0, 0.199)
    assert component.block.steps == 1


def test_sampling_starts_again_with_initialisation():
    component = Component(Sampler)
    component.set([0], [0.2])
    component.start()
    for n in range(5):
        component.do_step(0.1 * n, 0.1)
    assert component.tick == 2
    component.settle()
    assert component.tick == 0


def test_samples_are_kept_at_a_late_start_time():
    """A start counted from an epoch: at 7.8e8 s time is rounded to 1e-7 s, more than 1e-9 periods."""
    component = Component(Sampler)
    component.set([0], [0.3])
    component.start_time = 7.8e8
    component.start()
    for n in range(200):
        component.do_step(7.8e8 + n * 0.3, 0.3)
    assert component.block.steps == 200


def test_samples_are_kept_by_an_importer_that_adds_up_its_time():
    component = Component(Sampler)
    component.set([0], [0.1])
    component.start()
    t = 0.0
    for _ in range(20000):
        component.do_step(t, 0.1)
        t += 0.1
    assert component.block.steps == 20000


def lander_in_flight():
    """A plant halfway through a turning burn."""
    component = Component(FlatMoonLander)
    component.set(
        references(component, "thrust", "thrust_direction", "thrust_direction_rate", "burn_duration"),
        [4500.0, 0.8, 0.0, 0.6, 0.003, 0.01, -0.004, 1.15],
    )
    return component, 0.1


def navigation_in_flight():
    component = Component(NoisyNavigation)
    names = ("position", "velocity", "position_sigma", "velocity_sigma")
    component.set(references(component, *names), [1e5, 0.0, 1e4, -900.0, 0.0, 0.0, 20.0, 0.2])
    return component, 0.1


def guidance_in_flight():
    component = Component(AnalyticGuidance)
    component.set(
        references(component, "position", "velocity", "sample_period"), [1e5, 0.0, 1.05e4, -948.0, 0.0, -47.0, 0.3]
    )
    return component, 0.1


def filter_in_flight():
    return Component(FormingFilter), 0.1


@pytest.mark.parametrize("made", [lander_in_flight, navigation_in_flight, guidance_in_flight, filter_in_flight])
@pytest.mark.parametrize("fresh", [False, True])
def test_a_restored_state_repeats_the_flight_to_the_last_bit(made, fresh):
    """Saved mid flight (between samples, mid burn), by value, into the same or a new instance."""
    component, h = made()
    component.start()
    for n in range(8):
        component.do_step(n * h, h)
    saved = pickle.loads(pickle.dumps(component.get_state()))
    untouched = copy.deepcopy(saved)
    first = []
    for n in range(8, 20):
        component.do_step(n * h, h)
        first.append(everything(component))
    assert first[-1] != saved["values"]
    other = Component(type(component.block)) if fresh else component
    other.set_state(saved)
    assert saved == untouched
    assert everything(other) == saved["values"]
    second = []
    for n in range(8, 20):
        other.do_step(n * h, h)
        second.append(everything(other))
    assert second == first


def test_a_saved_state_is_not_changed_by_later_steps():
    component, h = navigation_in_flight()
    component.start()
    saved = component.get_state()
    before = copy.deepcopy(saved)
    component.do_step(0.0, h)
    assert saved == before


def test_state_saved_in_initialisation_restores_initialisation():
    component = Component(Probe)
    component.set([0], [3.0])
    saved = component.get_state()
    component.start()
    component.do_step(0.0, 0.1)
    component.set_state(saved)
    assert component.initialising
    component.set([0], [4.0])
    assert component.get([3]) == [4.0]


def test_two_instances_share_nothing():
    first, second = Component(Probe), Component(Probe)
    first.set([1], [50.0])
    first.start()
    assert second.get([1, 3]) == [1.0, 2.0]
