"""Saved and restored states of a component.

Truth: components compared with themselves: a restored state must repeat every value to the last bit.
"""

import copy
import pickle

import pytest

from perilune.fmus_src.disturbances.forming_filter import FormingFilter
from perilune.fmus_src.guidance.analytic import AnalyticGuidance
from perilune.fmus_src.navigation.noisy import NoisyNavigation
from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander
from perilune.fmus_src.runtime import BlockInstance
from tests.support.kernels.probe import Probe, everything, references


def lander_in_flight():
    """Return a plant halfway through a turning burn."""
    component = BlockInstance(FlatMoonLander)
    component.set(
        references(component, "thrust", "thrust_direction", "thrust_direction_rate", "burn_duration"),
        [4500.0, 0.8, 0.0, 0.6, 0.003, 0.01, -0.004, 1.15],
    )
    return component, 0.1


def navigation_in_flight():
    component = BlockInstance(NoisyNavigation)
    names = ("position", "velocity", "position_sigma", "velocity_sigma")
    component.set(references(component, *names), [1e5, 0.0, 1e4, -900.0, 0.0, 0.0, 20.0, 0.2])
    return component, 0.1


def guidance_in_flight():
    component = BlockInstance(AnalyticGuidance)
    component.set(
        references(component, "position", "velocity", "sample_period"), [1e5, 0.0, 1.05e4, -948.0, 0.0, -47.0, 0.3]
    )
    return component, 0.1


def filter_in_flight():
    return BlockInstance(FormingFilter), 0.1


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
    other = BlockInstance(type(component.block)) if fresh else component
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
    component = BlockInstance(Probe)
    component.set([0], [3.0])
    saved = component.get_state()
    component.start()
    component.do_step(0.0, 0.1)
    component.set_state(saved)
    assert component.initialising
    component.set([0], [4.0])
    assert component.get([3]) == [4.0]
