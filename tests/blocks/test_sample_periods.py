"""Blocks with a sample period: communication points at which they sample.

Truth: a block that counts its steps and records their times; exact fractions for sample instants.
"""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.block import Block, Output, Parameter
from perilune.fmus_src.runtime import BlockInstance
from tests.support.kernels.probe import Probe
from tests.support.lengths import either


class Sampler(Block):
    """Counts its steps and notes their times."""

    sample_period = Parameter(0.0, unit="s", description="time between samples")
    steps = Output(0, description="steps taken")
    last = Output(0.0, unit="s", description="end of the last step")

    def step(self, t: float, h: float) -> None:
        self.steps = self.steps + 1
        self.last = t + h


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
    component = BlockInstance(Sampler)
    component.set([0], [float(Fraction(period))])
    component.start_time = start
    component.start()
    for n in range(2000):
        component.do_step(start + n * h, h)
        ticks = (n + 1) / exact  # whole ticks reached at the end of the step
        assert component.block.steps == ticks.numerator // ticks.denominator


@given(st.integers(1, 400), st.integers(1, 400), st.integers(0, 10**6))
@settings(max_examples=either(60, 20), deadline=None)
def test_no_sample_is_lost_or_doubled_for_any_period(step_thousandths, more_thousandths, start_thousandths):
    exact = Fraction(step_thousandths + more_thousandths, step_thousandths)
    h, start = step_thousandths / 1000.0, start_thousandths / 1000.0
    component = BlockInstance(Sampler)
    component.set([0], [(step_thousandths + more_thousandths) / 1000.0])
    component.start_time = start
    component.start()
    for n in range(300):
        component.do_step(start + n * h, h)
        assert component.block.steps == ((n + 1) / exact).__floor__()


def test_sample_period_of_zero_steps_at_every_communication_point():
    component = BlockInstance(Sampler)
    component.start()
    for n in range(10):
        component.do_step(0.1 * n, 0.1)
    assert component.get([1]) == [10]


def test_blocks_without_a_sample_period_step_always():
    component = BlockInstance(Probe)
    component.start()
    for n in range(3):
        before = component.get([5])
        component.do_step(0.1 * n, 0.1)
        assert component.get([5]) != before


def test_outputs_hold_between_samples():
    component = BlockInstance(Sampler)
    component.set([0], [0.5])
    component.start()
    lasts = []
    for n in range(10):
        component.do_step(0.125 * n, 0.125)
        lasts.append(component.block.last)
    assert lasts == [0.0] * 3 + [0.5] * 4 + [1.0] * 3


@pytest.mark.parametrize(("step", "samples"), [(0.2, 2), (0.21, 2), (1.0, 10)])
def test_a_step_takes_all_its_samples(step, samples):
    component = BlockInstance(Sampler)
    component.set([0], [0.1])
    component.start()
    component.do_step(0.0, step)
    assert component.block.steps == samples


def test_a_step_of_almost_two_periods_that_holds_one_sample_is_taken():
    component = BlockInstance(Sampler)
    component.set([0], [0.1])
    component.start()
    component.do_step(0.0, 0.199)
    assert component.block.steps == 1


def test_sampling_starts_again_with_initialisation():
    component = BlockInstance(Sampler)
    component.set([0], [0.2])
    component.start()
    for n in range(5):
        component.do_step(0.1 * n, 0.1)
    assert component.tick == 2
    component.settle()
    assert component.tick == 0


def test_samples_are_kept_at_a_late_start_time():
    """A start counted from an epoch: at 7.8e8 s time is rounded to 1e-7 s, more than 1e-9 periods."""
    component = BlockInstance(Sampler)
    component.set([0], [0.3])
    component.start_time = 7.8e8
    component.start()
    for n in range(200):
        component.do_step(7.8e8 + n * 0.3, 0.3)
    assert component.block.steps == 200


def test_samples_are_kept_by_an_importer_that_adds_up_its_time():
    component = BlockInstance(Sampler)
    component.set([0], [0.1])
    component.start()
    t = 0.0
    for _ in range(20000):
        component.do_step(t, 0.1)
        t += 0.1
    assert component.block.steps == 20000
