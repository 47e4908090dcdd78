"""Rendezvous guidance: boundary conditions, derivatives, and sample times of translation control.

Truth: the conditions of the problem, to 1e-9 at every phase boundary; the final point and range that follow from
the published data; numeric differentiation of the outputs; the integral of the commanded means, which is the
planned velocity; scipy's rotations.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.guidance.rendezvous_guidance import RendezvousGuidance
from tests.support.lengths import either

TARGET = 500.0 * np.array([math.cos(math.radians(20.0)), math.sin(math.radians(20.0)), 0.0])
DRIFT = np.array([-0.05, 0.05, 0.075])
SPIN = np.array([-0.608, 0.228, 0.760]) / np.linalg.norm([-0.608, 0.228, 0.760])
STEP = 0.125


def guidance(**parameters):
    block = RendezvousGuidance(**parameters)
    block.initialize()
    return block


def at(block, time):
    """Return position, velocity, quaternion and angular velocity planned for a time (the clock apart)."""
    block.publish(time)
    return (
        np.array(block.planned_position),
        np.array(block.planned_velocity),
        np.array(block.planned_quaternion),
        np.array(block.planned_angular_velocity),
    )


def acceleration(block, time, side):
    """Return one-sided derivative of the planned velocity, exact for polynomials up to the second degree."""
    d = 1e-2 * side
    v0, v1, v2 = (at(block, time + k * d)[1] for k in range(3))
    return (-1.5 * v0 + 2.0 * v1 - 0.5 * v2) / d


@pytest.mark.parametrize("degree", [5, 6])
def test_conditions_at_all_phase_boundaries(degree):
    block = guidance(spline_degree=degree)
    arrival = TARGET + 4250.0 * DRIFT - 30.0 * SPIN
    position, velocity, *_ = at(block, 0.0)
    assert position.tolist() == velocity.tolist() == [0.0] * 3
    for time in (1420.0, 1520.0, 4250.0):  # continuous
        before, after = at(block, time - 1e-10), at(block, time + 1e-10)
        assert before[0] == pytest.approx(after[0], abs=1e-9)
        assert before[1] == pytest.approx(after[1], abs=1e-9)
    end = at(block, 4250.0)
    assert end[0] == pytest.approx(arrival, abs=1e-9)
    assert end[1] == pytest.approx(DRIFT, abs=1e-12)
    assert acceleration(block, 1420.0, 1) == pytest.approx(np.zeros(3), abs=1e-12)
    for time, side in ((1520.0, 1), (1520.0, -1), (4250.0, -1), (4250.0, 1)):
        assert acceleration(block, time, side) == pytest.approx(np.zeros(3), abs=1e-9)
    if degree == 6:  # jerk at the end
        d = 1.0
        values = [at(block, 4250.0 - k * d)[1] for k in range(3)]
        assert (values[0] - 2.0 * values[1] + values[2]) / d**2 == pytest.approx(np.zeros(3), abs=1e-9)
    late = at(block, 5000.0)
    assert late[0] == pytest.approx(arrival + 750.0 * DRIFT, abs=1e-9)
    assert TARGET + 5000.0 * DRIFT - late[0] == pytest.approx(30.0 * SPIN, abs=1e-9)


def test_published_numbers():
    block = guidance()
    assert block.place == pytest.approx([275.593, 376.667, 295.941], abs=1e-3)
    assert block.acceleration == pytest.approx([1.1133e-4, 0.9986e-4, 0.6267e-4], abs=5e-9)
    block.publish(1520.0)
    assert np.linalg.norm(block.planned_relative_position) == pytest.approx(299.8, abs=0.05)
    block.publish(1480.0)
    turn = Rotation.from_quat(block.planned_quaternion, scalar_first=True).as_rotvec()
    assert turn / np.linalg.norm(turn) == pytest.approx([0.0, -0.9578, 0.2874], abs=1e-4)
    block.publish(4000.0)
    angle = Rotation.from_quat(block.planned_quaternion, scalar_first=True).magnitude()
    assert math.degrees(angle) == pytest.approx(127.46, abs=5e-3)


def test_camera_ends_along_the_spin_axis():
    block = guidance()
    for time in (1520.0, 3000.0, 5000.0):
        _, _, q, rate = at(block, time)
        assert Rotation.from_quat(q, scalar_first=True).apply([1.0, 0.0, 0.0]) == pytest.approx(SPIN, abs=1e-12)
        assert rate.tolist() == [0.0] * 3


def test_velocity_of_the_spline_goes_straight_without_overshoot():
    """The free choice: on the line from the coasting velocity to the object's, monotone, symmetric in time."""
    block = guidance()
    first = at(block, 1520.0)[1]
    change = DRIFT - first
    parts = []
    for s in np.linspace(0.0, 1.0, 41):
        part = at(block, 1520.0 + 2730.0 * s)[1] - first
        along = part @ change / (change @ change)
        assert part == pytest.approx(along * change, abs=1e-12)
        assert along == pytest.approx(3.0 * s**2 - 2.0 * s**3, abs=1e-9)
        parts.append(along)
    assert (np.diff(parts) > 0.0).all()


@pytest.mark.parametrize(("degree", "factor", "documented"), [(5, 1.5, 1.252e-4), (6, 1.875, 1.565e-4)])
def test_largest_acceleration_of_the_spline(degree, factor, documented):
    """6 s (1 - s) or 30 s^2 (1 - s)^2 times the change of velocity over the duration: half way."""
    block = guidance(spline_degree=degree)
    change = np.linalg.norm(DRIFT - at(block, 1520.0)[1])
    sizes = [np.linalg.norm(acceleration(block, 1520.0 + 2730.0 * s, 1)) for s in np.linspace(0.0, 1.0, 101)]
    assert np.argmax(sizes) == 50
    assert max(sizes) == pytest.approx(factor * change / 2730.0, rel=1e-4)
    assert max(sizes) == pytest.approx(documented, rel=5e-4)


@given(st.floats(1.0, 4999.0))
def test_outputs_are_derivatives_of_each_other(time):
    block = guidance(spline_degree=6, attitude_period=0.0)
    if min(abs(time - boundary) for boundary in (1420.0, 1520.0, 4250.0)) < 0.1:
        return
    d = 0.02
    before, here, after = at(block, time - d), at(block, time), at(block, time + d)
    assert here[1] == pytest.approx((after[0] - before[0]) / (2.0 * d), abs=1e-9)
    steps = [Rotation.from_quat(q, scalar_first=True) for q in (before[2], after[2])]
    assert here[3] == pytest.approx((steps[0].inv() * steps[1]).as_rotvec() / (2.0 * d), abs=1e-8)
    block.publish(time)
    actual = np.array(block.planned_angular_acceleration)
    assert actual == pytest.approx((after[3] - before[3]) / (2.0 * d), abs=1e-7)


def test_angular_acceleration_is_that_of_the_middle_of_the_attitude_period():
    ahead, now = guidance(), guidance(attitude_period=0.0)
    for time in (1419.9, 1420.0, 1444.0, 1519.9, 1520.0):
        ahead.publish(time)
        now.publish(time + 0.125)
        assert ahead.planned_angular_acceleration == pytest.approx(now.planned_angular_acceleration, abs=1e-15)


def fly(block, end, step=STEP):
    """Return rows of (time, count, period, planned acceleration, planned velocity, phase)."""
    rows = []
    for k in range(round(end / step) + 1):
        if k:
            block.step((k - 1) * step, step)
        rows.append(
            (
                k * step,
                block.translation_count,
                block.translation_period,
                np.array(block.planned_acceleration),
                np.array(block.planned_velocity),
                block.phase,
            )
        )
    return rows


def commands(rows):
    """Return the rows at which a tick happens."""
    return [row for before, row in zip([None, *rows], rows, strict=False) if before is None or before[1] != row[1]]


def test_clock_ticks_every_eight_and_then_every_four_seconds():
    rows = fly(guidance(), 1600.0)
    ticks = commands(rows)
    assert [row[0] for row in ticks] == [8.0 * k for k in range(190)] + [1520.0 + 4.0 * k for k in range(21)]
    assert [row[1] for row in ticks] == list(range(1, len(ticks) + 1))
    assert all(row[2] == (8.0 if row[0] < 1520.0 else 4.0) for row in ticks)
    assert {row[0]: row[5] for row in rows if row[5] != 1}[1420.0] == 2
    assert [row[5] for row in rows if row[0] in (0.0, 1419.875, 1420.0, 1519.875, 1520.0)] == [1, 1, 2, 2, 3]


@pytest.mark.parametrize(
    "clock",
    [
        {},
        {"delay_fraction": 0.0},
        {"delay_fraction": 1.0},
        {"turn_end": 1522.0},
        {"slow_period": 12.0, "fast_period": 4.0},
        {"slow_period": 1.0},
    ],
    ids=str,
)
def test_commanded_means_integrate_to_the_planned_velocity(clock):
    """Jets that hold each mean from its delay on until the next one has the planned velocity at every change."""
    block = guidance(**clock)
    delay = block.delay_fraction
    ticks = commands(fly(block, 1600.0))
    changes = [row[0] + delay * row[2] for row in ticks]
    velocity = np.zeros(3)
    for now, following, row in zip(changes, changes[1:], ticks, strict=False):
        if now >= following:
            continue  # replaced before it acts
        velocity = velocity + row[3] * (following - (now if row[1] > 1 else 0.0))
        assert velocity == pytest.approx(at(block, following)[1], abs=1e-12)


@settings(max_examples=either(20, 6))
@given(
    st.lists(st.floats(-500.0, 500.0), min_size=3, max_size=3),
    st.lists(st.floats(-0.2, 0.2), min_size=3, max_size=3),
    st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=3).filter(lambda v: np.linalg.norm(v) > 0.1),
    st.floats(100.0, 1000.0),
    st.floats(50.0, 200.0),
    st.floats(500.0, 3000.0),
)
def test_any_object_is_met(position, velocity, axis, start, turn, approach):
    arrival = start + turn + approach
    block = guidance(
        target_position=position,
        target_velocity=velocity,
        spin_axis=axis,
        turn_start=start,
        turn_end=start + turn,
        arrival_time=arrival,
    )
    assert block.status == 0
    block.publish(arrival)
    unit = np.array(axis) / np.linalg.norm(axis)
    assert block.planned_relative_position == pytest.approx(30.0 * unit, abs=1e-9)
    assert block.planned_velocity == pytest.approx(velocity, abs=1e-9)
    camera = Rotation.from_quat(block.planned_quaternion, scalar_first=True).apply([1.0, 0.0, 0.0])
    assert camera == pytest.approx(unit, abs=1e-9)


@pytest.mark.parametrize("wrong", [{"turn_end": 1000.0}, {"turn_start": 0.0}, {"spin_axis": [0.0, 0.0, 0.0]}], ids=str)
def test_impossible_plans_are_told_and_stay_at_rest(wrong):
    block = guidance(**wrong)
    rows = fly(block, 20.0)
    assert block.status == 1
    assert all(not row[3].any() and not row[4].any() for row in rows)
    assert block.planned_quaternion == [1.0, 0.0, 0.0, 0.0]


def test_results_do_not_depend_on_communication_steps():
    coarse, fine = guidance(), guidance()
    for k in range(200):
        coarse.step(0.125 * k, 0.125)
        for half in range(2):
            fine.step(0.125 * k + 0.0625 * half, 0.0625)
        assert vars(coarse) == vars(fine)


def test_times_count_from_the_start():
    early, late = guidance(), RendezvousGuidance()
    late.start_time = 100.0
    late.initialize()
    for k in range(100):
        early.step(0.125 * k, 0.125)
        late.step(100.0 + 0.125 * k, 0.125)
    assert late.planned_position == early.planned_position
    assert late.translation_count == early.translation_count
