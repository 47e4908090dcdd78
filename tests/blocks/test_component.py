"""Life cycle of a component (`perilune.fmus_src.runtime.BlockInstance`), compared with the rules of FMI co-simulation.

Truth: blocks whose behaviour is known by construction (accumulators, logs of their calls), and real blocks compared
with themselves: a repeated initialisation must repeat every value to the last bit.
"""

import pytest

from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.disturbances.forming_filter import FormingFilter
from perilune.fmus_src.navigation.noisy import NoisyNavigation
from perilune.fmus_src.runtime import BlockInstance
from tests.support.kernels.probe import Probe, everything, reference, references


def test_value_references_number_the_elements_in_order_of_declaration():
    component = BlockInstance(Probe)
    assert references(component, "gain", "level", "scaled", "number") == [0, 1, 2, 3, 4, 5]
    component.set([0, 2], [3.0, 7.0])
    assert component.block.gain == 3.0
    assert component.block.level == [1.0, 7.0]
    assert component.get([2, 0, 1]) == [7.0, 3.0, 1.0]


def test_a_read_settles_an_instance_that_was_set():
    component = BlockInstance(Probe)
    assert component.get([3, 4]) == [2.0, 20.0]
    component.set([0], [5.0])
    component.set([1], [4.0])
    assert component.get([3, 4]) == [20.0, 50.0]  # not added to the first settling
    assert component.get([reference(component, "runs")]) == [1]


def test_reads_without_a_change_do_not_settle_again():
    component = BlockInstance(Probe)
    component.get([3])
    component.block.scaled = [-1.0, 20.0]  # a second settling would overwrite this
    assert component.get([3]) == [-1.0]


def test_start_settles_once_and_ends_initialisation():
    component = BlockInstance(Probe)
    component.set([1], [4.0])
    component.start()
    assert component.block.scaled == [8.0, 20.0]
    component.set([1], [100.0])
    assert component.get([3]) == [8.0]  # after initialisation a set value waits for the next step
    component.do_step(0.0, 0.1)
    assert component.get([3]) == [200.0]


def test_lists_keep_their_identity_through_settling_restoring_and_assignment():
    component = BlockInstance(Probe)
    generator = component.block.generator
    component.start()
    component.set_state(component.get_state())
    component.block.generator = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert component.block.generator is generator
    assert generator == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


def test_elements_are_got_and_set_in_any_order_and_number():
    component = BlockInstance(Probe)
    component.start()
    count = len(component.elements)
    component.write(list(range(count)), [float(k) for k in range(count)])
    for chosen in ([2, 1], [0, 2, 3], [8, 7, 6], [1, 2, 1], [4, 5, 6, 7, 8, 9, 10, 11], []):
        assert component.get(chosen) == [float(k) for k in chosen]
    component.set([2, 1], [-2.0, -1.0])
    component.write([9], [-9.0])
    assert component.block.level == [-1.0, -2.0]
    assert component.get([9, 10, 1]) == [-9.0, 10.0, -1.0]
    for bad in ([-1], [count]):
        with pytest.raises(IndexError):
            component.get(bad)
    with pytest.raises(ValueError, match="2 values for 1 value references"):
        component.set([1], [1.0, 2.0])


def test_repeated_initialisation_repeats_the_random_stream():
    once, often = BlockInstance(Probe), BlockInstance(Probe)
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
    once, often = BlockInstance(block_class), BlockInstance(block_class)
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
    component = BlockInstance(catalogue()[name])
    first = everything(component)
    component.unsettled = True
    assert everything(component) == first
    component.start()


def test_two_instances_share_nothing():
    first, second = BlockInstance(Probe), BlockInstance(Probe)
    first.set([1], [50.0])
    first.start()
    assert second.get([1, 3]) == [1.0, 2.0]
