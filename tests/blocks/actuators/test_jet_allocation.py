"""Jet allocations: timing of commands, frames, and the force and torque of each block.

Truth: the jets' matrix from the published axes and arms, scipy's rotations, sums of commanded impulses, and the
schedule of delayed commands, by hand. The allocation rules are tested against linear programming in
tests/mathlib/actuators/test_jets.py. Tolerance 1e-12 N and N.m.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.actuators.jet_allocation_least_propellant import JetAllocationLeastPropellant
from perilune.fmus_src.actuators.jet_allocation_pseudo_inverse import JetAllocationPseudoInverse
from perilune.fmus_src.actuators.jet_allocation_quantised import JetAllocationQuantised
from perilune.fmus_src.runtime import BlockInstance
from tests.support.lengths import either

BLOCKS = [JetAllocationPseudoInverse, JetAllocationLeastPropellant, JetAllocationQuantised]
CONTINUOUS = BLOCKS[:2]
CA, SA, DIAGONAL = math.cos(math.radians(35.25)), math.sin(math.radians(35.25)), math.sqrt(0.5)
AXES = np.array([CA * DIAGONAL, CA * DIAGONAL, SA])
SIGNS = np.array(list(itertools.product([1.0, -1.0], repeat=3)))
# Nozzles lean outwards at every corner, which is the published list in other words.
B = -np.vstack([(SIGNS * AXES).T, np.cross(SIGNS * [1.0, 0.7, 0.6], SIGNS * AXES).T])
QUANTUM = 0.05
CELL = 2.0 * QUANTUM * AXES  # the lattice of forces without torque, N
seeds = st.integers(0, 2**32 - 1)


def started(block_class, force=(0.0, 0.0, 0.0), **settings_):
    component = BlockInstance(block_class)
    for name, value in {"force_command": list(force), **settings_}.items():
        setattr(component.block, name, value)
    component.start()
    return component


def command(component, t, force, torque=(0.0, 0.0, 0.0), period=None):
    """Give a new command at t + 0.125 s and step there."""
    block = component.block
    block.force_command = force
    block.torque_command = torque
    if period is not None:
        block.translation_period = period
    block.command_count += 1
    component.do_step(t, 0.125)


def wait(component, t, until):
    """Step without a new command from t to ``until``; returns that time."""
    while t < until:
        component.do_step(t, 0.125)
        t += 0.125
    return t


@pytest.mark.parametrize("block_class", BLOCKS)
@pytest.mark.parametrize("step", [0.125, 0.0625])
def test_levels_follow_a_quarter_of_the_period_after_each_command(block_class, step):
    """Commands at 0, 8 and 16 s for 8 s, then at 24, 28 and 32 s for 4 s: levels from 2, 10, 18, 25, 29 and 33 s."""
    forces = [CELL * n for n in ([2, 0, 0], [0, -2, 0], [1, 1, 1], [0, 0, 2], [-1, 1, 3], [0, 0, 0])]
    commands = dict(zip([0.0, 8.0, 16.0, 24.0, 28.0, 32.0], forces, strict=True))
    switches = dict(zip([2.0, 10.0, 18.0, 25.0, 29.0, 33.0], forces, strict=True))
    component = started(block_class, forces[0])
    block = component.block
    expected, n = np.zeros(3), 0
    assert block.jet_thrust == [0.0] * 8
    while n * step < 40.0:
        t = n * step
        n += 1
        if n * step in commands:
            block.force_command = commands[n * step]
            block.translation_period = 8.0 if n * step < 24.0 else 4.0
            block.command_count += 1
        else:
            block.force_command = [9.0, 9.0, 9.0]  # no command: the count is the same
        component.do_step(t, step)
        expected = switches.get(n * step, expected)
        assert block.allocated_force == pytest.approx(expected, abs=1e-15)
        assert np.array(block.jet_thrust) @ B.T == pytest.approx([*expected, 0.0, 0.0, 0.0], abs=1e-15)
        assert block.status == 0


@pytest.mark.parametrize("block_class", BLOCKS)
def test_without_delay_the_first_command_is_there_at_the_start(block_class):
    component = started(block_class, CELL * [2, 0, 2], delay_fraction=0.0, command_count=17)
    assert component.block.allocated_force == pytest.approx(CELL * [2, 0, 2], abs=1e-15)
    command(component, 0.0, CELL)
    assert component.block.allocated_force == pytest.approx(CELL, abs=1e-15)


@pytest.mark.parametrize("block_class", BLOCKS)
def test_delay_of_a_whole_period_puts_each_command_out_when_the_next_comes(block_class):
    component = started(block_class, CELL * [2, 0, 0], delay_fraction=1.0, translation_period=0.5)
    t = 0.0
    for n in range(1, 6):
        t = wait(component, t, 0.5 * n - 0.125)
        command(component, t, CELL * [2 * n + 2, 0, 0])
        t += 0.125
        assert component.block.allocated_force == pytest.approx(CELL * [2 * n, 0, 0], abs=1e-15)


@pytest.mark.parametrize("block_class", BLOCKS)
def test_command_that_comes_while_another_waits_takes_its_place(block_class):
    component = started(block_class, CELL * [2, 0, 0])
    command(component, 0.875, CELL * [0, 2, 0])  # at 1 s, before the first is due
    wait(component, 1.0, 2.875)
    assert component.block.allocated_force == [0.0, 0.0, 0.0]
    wait(component, 2.875, 3.0)
    assert component.block.allocated_force == pytest.approx(CELL * [0, 2, 0], abs=1e-15)


@pytest.mark.parametrize("block_class", BLOCKS)
def test_time_counts_from_the_start_of_the_flight(block_class):
    component = BlockInstance(block_class)
    component.start_time = 100.0
    component.block.force_command = CELL
    component.start()
    assert wait(component, 100.0, 101.875) == 101.875
    assert component.block.allocated_force == [0.0, 0.0, 0.0]
    wait(component, 101.875, 102.0)
    assert component.block.allocated_force == pytest.approx(CELL, abs=1e-15)


@pytest.mark.parametrize("block_class", CONTINUOUS)
@given(seeds)
@settings(max_examples=either(60, 20), deadline=None)
def test_force_is_inertial_and_torque_is_of_the_body(block_class, seed):
    random = np.random.default_rng(seed)
    attitude = Rotation.random(rng=random)
    force, torque = random.uniform(-0.1, 0.1, 3), random.uniform(-0.01, 0.01, 3)
    component = started(
        block_class,
        force,
        torque_command=torque,
        quaternion=attitude.as_quat(scalar_first=True),
        delay_fraction=0.0,
    )
    block = component.block
    assert attitude.apply(block.allocated_force) == pytest.approx(force, abs=1e-12)
    assert block.allocated_torque == pytest.approx(torque, abs=1e-12)
    assert B @ block.jet_thrust == pytest.approx([*attitude.inv().apply(force), *torque], abs=1e-12)
    assert block.status == 0


@pytest.mark.parametrize("block_class", CONTINUOUS)
@pytest.mark.parametrize("size", [0.55, 1.5, 1e3, 1e90])
def test_saturation_keeps_the_direction_and_says_so(block_class, size):
    desired = size * np.array([1.0, 0.9, -0.9, 0.005, -0.01, 0.004])
    component = started(block_class, desired[:3], torque_command=desired[3:], delay_fraction=0.0)
    block = component.block
    given_wrench = np.array([*block.allocated_force, *block.allocated_torque])
    assert given_wrench / given_wrench[0] == pytest.approx(desired / desired[0], abs=1e-12)
    assert min(block.jet_thrust) >= 0.0
    assert max(block.jet_thrust) <= 0.5
    exact = abs(given_wrench[0] - desired[0]) < 1e-12
    assert block.status == int(not exact)
    assert exact == (size == 0.55 and block_class is JetAllocationLeastPropellant)


def test_least_propellant_gives_what_the_rule_of_the_paper_must_scale():
    """0.55 N along each axis: any two make 1.1 N, less than 1.155 N, all three more than 1.154 N."""
    force = [0.55, 0.55, 0.55]
    minimum = started(JetAllocationLeastPropellant, force, delay_fraction=0.0).block
    paper = started(JetAllocationPseudoInverse, force, delay_fraction=0.0).block
    assert (minimum.status, paper.status) == (0, 1)
    assert minimum.allocated_force == pytest.approx(force, abs=1e-12)
    assert sum(paper.allocated_force) == pytest.approx(1.1547, abs=1e-4)


@given(seeds)
@settings(max_examples=either(60, 20), deadline=None)
def test_propellant_of_a_force_is_that_of_all_axes_or_of_two(seed):
    """Sums of thrusts: |F1| + |F2| + |F3| over the axes' cosines by the paper's rule, the two largest at best."""
    force = np.random.default_rng(seed).uniform(-0.38, 0.38, 3)
    minimum = started(JetAllocationLeastPropellant, force, delay_fraction=0.0).block
    paper = started(JetAllocationPseudoInverse, force, delay_fraction=0.0).block
    parts = np.sort(np.abs(force) / AXES)
    assert sum(paper.jet_thrust) == pytest.approx(parts.sum(), abs=1e-12)
    assert sum(minimum.jet_thrust) == pytest.approx(parts[1:].sum(), abs=1e-12)


@pytest.mark.parametrize("block_class", BLOCKS)
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e200])
@pytest.mark.parametrize("name", ["force_command", "torque_command", "quaternion"])
def test_command_that_is_no_number_shuts_the_jets_off(block_class, bad, name):
    component = started(block_class, CELL * [2, 0, 0], delay_fraction=0.0)
    saved = list(getattr(component.block, name))
    values = list(getattr(component.block, name))
    values[1] = bad
    setattr(component.block, name, values)
    component.block.command_count += 1
    component.do_step(0.0, 0.125)
    assert component.block.status == 3
    assert component.block.jet_thrust == [0.0] * 8
    setattr(component.block, name, saved)
    command(component, 0.125, CELL * [0, 0, 2])
    assert component.block.status == 0
    assert component.block.allocated_force == pytest.approx(CELL * [0, 0, 2], abs=1e-15)


@pytest.mark.parametrize("block_class", BLOCKS)
def test_geometry_that_cannot_give_a_component_says_so(block_class):
    """Nozzles in the xy plane give no force along z."""
    component = started(block_class, CELL * [2, 0, 0], jet_tilt=0.0, delay_fraction=0.0)
    assert component.block.status == 0
    command(component, 0.0, [0.2, 0.0, 0.1])
    assert component.block.status == 2
    assert component.block.allocated_force[2] == 0.0


@given(seeds, st.floats(0.0, 0.35))
@settings(max_examples=either(100, 25), deadline=None)
def test_quantised_force_has_whole_levels_no_torque_and_the_right_mean(seed, size):
    """Over turning attitudes and both periods: what is owed never exceeds the cell's radius times the period."""
    random = np.random.default_rng(seed)
    component = started(JetAllocationQuantised, delay_fraction=0.0)
    block = component.block
    wanted_impulse, given_impulse = np.zeros(3), np.zeros(3)
    for n in range(60):
        force = size * random.uniform(-1.0, 1.0, 3)
        period = 8.0 if n < 30 else 4.0
        attitude = Rotation.random(rng=random)
        block.quaternion = attitude.as_quat(scalar_first=True)
        command(component, 0.125 * n, force, period=period)
        levels = [round(p / QUANTUM) for p in block.jet_thrust]
        assert block.jet_thrust == [QUANTUM * k for k in levels]
        assert max(levels) <= 10
        assert min(levels) >= 0
        wrench = B @ block.jet_thrust
        assert wrench[3:] == pytest.approx([0.0, 0.0, 0.0], abs=1e-15)
        assert block.allocated_torque == pytest.approx([0.0, 0.0, 0.0], abs=1e-15)
        cells = wrench[:3] / CELL
        assert cells == pytest.approx(np.round(cells), abs=1e-12)
        assert len({int(k) % 2 for k in np.round(cells)}) == 1
        assert block.status == 0
        wanted_impulse += force * period
        given_impulse += attitude.apply(wrench[:3]) * period
        owed = wanted_impulse - given_impulse
        assert block.owed_impulse == pytest.approx(owed, abs=1e-11)
        # the farthest point of a body-centred cubic cell: sqrt(5)/2 of its edge
        assert np.linalg.norm(owed) <= math.sqrt(1.25) * CELL.max() * period * (1.0 + 1e-9)


def test_quantised_constant_force_is_exact_in_the_mean():
    force = np.array([0.111, -0.1, 0.0627])  # the thrust of the acceleration phase
    component = started(JetAllocationQuantised, delay_fraction=0.0)
    total = np.zeros(3)
    for n in range(1000):
        command(component, 0.125 * n, force)
        total += component.block.allocated_force
    assert total / 1000 == pytest.approx(force, abs=CELL.max() / 1000)


@given(seeds, st.floats(1.0, 50.0))
@settings(max_examples=either(100, 25), deadline=None)
def test_quantised_saturation_is_graceful(seed, size):
    """Beyond the attainable set: largest levels kept, direction within a cell, status 1, and no debt of it later."""
    force = size * np.random.default_rng(seed).normal(size=3)
    component = started(JetAllocationQuantised, force, delay_fraction=0.0)
    block = component.block
    pair = np.sort(np.abs(force / CELL))[1:].sum()
    for n in range(20):
        assert max(block.jet_thrust) <= 0.5
        assert block.status == int(pair > 20.0) or n > 0
        scaled = force * min(1.0, 20.0 / pair)
        assert np.linalg.norm(np.array(block.allocated_force) - scaled) <= 3.0 * np.linalg.norm(CELL)
        command(component, 0.125 * n, force)
    command(component, 3.0, [0.0, 0.0, 0.0])
    command(component, 3.125, [0.0, 0.0, 0.0])
    assert block.status == 0
    assert np.abs(np.array(block.allocated_force) / CELL).max() < 3.0


def test_quantised_leaves_torque_out_and_says_so():
    component = started(JetAllocationQuantised, CELL * [2, 2, 0], torque_command=[0.0, 0.01, 0.0], delay_fraction=0.0)
    assert component.block.status == 2
    assert component.block.allocated_force == pytest.approx(CELL * [2, 2, 0], abs=1e-15)
    assert component.block.allocated_torque == pytest.approx([0.0, 0.0, 0.0], abs=1e-16)


def test_independent_rounding_would_make_the_torque_that_the_lattice_avoids():
    """Why not round each jet: least-propellant thrusts rounded to 0.05 N give millinewton metres."""
    random = np.random.default_rng(1)
    torques = []
    for _ in range(300):
        block = started(JetAllocationLeastPropellant, random.uniform(-0.15, 0.15, 3), delay_fraction=0.0).block
        torques.append(B[3:] @ (QUANTUM * np.round(np.array(block.jet_thrust) / QUANTUM)))
    rms = np.sqrt(np.square(torques).mean(axis=0))
    assert (rms > 1e-3).all()
    assert (rms < 2e-2).all()


@pytest.mark.parametrize("block_class", BLOCKS)
def test_declared_starts_alone_run(block_class):
    block = block_class()
    block.initialize()
    for n in range(40):
        block.step(0.125 * n, 0.125)
    assert block.jet_thrust == [0.0] * 8
    assert block.status == 0
