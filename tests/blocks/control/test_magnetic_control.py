"""Magnetic control, sample by sample: laws, dipole limit, timing and statuses.

Truth: values computed outside this package, by numpy from the laws; momentum perpendicular to the field, by projection;
sample times written out.
"""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from perilune.fmus_src.control.magnetic_control import MagneticControl, MagneticControlStatus
from perilune.fmus_src.interfaces.ports.space import MagneticMode

FIRST, SECOND = [2e-5, -1e-5, 3e-5], [2.1e-5, -9.5e-6, 2.92e-5]
MOMENTUM = [0.01, -0.02, 0.03]
UNLIMITED = (-9.538330358626743, -4.769165179313387, 7.630664286901408)
UNLOADING = (-0.43211526927718247, 0.48847813048724953, 0.46969051008389395)
MAGNETIC_TORQUE = np.array([1.872562125602468e-05, 2.24812665746555e-05, -6.152945682099007e-06])

components = st.floats(-1.0, 1.0, allow_subnormal=False)
vectors = st.tuples(components, components, components).map(np.array)


def control_of(mode, *fields, momentum=(0.0, 0.0, 0.0), **parameters):
    """Return the control after samples of the field, a second after each other, at the last of them."""
    control = MagneticControl(mode=mode, measured_field=fields[0], wheel_momentum=list(momentum), **parameters)
    control.initialize()
    for n, field in enumerate(fields[1:]):
        for k in range(4):
            if k == 3:
                control.measured_field, control.field_count = field, control.field_count + 1
            control.step(n + 0.25 * k, 0.25)
    return control


@pytest.mark.parametrize(("limit", "expected"), [(1e3, UNLIMITED), (5.0, (-5.0, -2.5, 4.0))])
def test_dipole_of_two_fields(limit, expected):
    control = control_of(MagneticMode.DETUMBLE, FIRST, SECOND, dipole_limit=limit)
    np.testing.assert_allclose(control.dipole, expected, rtol=1e-12)
    assert control.status == (MagneticControlStatus.GOOD if limit > 5.0 else MagneticControlStatus.LIMITED)
    assert tuple(control.feedforward_torque) == (0.0, 0.0, 0.0)


def test_a_slower_change_of_the_field_asks_for_less():
    """The same change in two seconds instead of one: half of the dipole."""
    control = control_of(MagneticMode.DETUMBLE, FIRST, SECOND, dipole_limit=1e3, field_period=2.0)
    np.testing.assert_allclose(control.dipole, np.divide(UNLIMITED, 2.0), rtol=1e-12)


def test_dipole_that_unloads_and_what_the_wheels_give_against_it():
    control = control_of(MagneticMode.UNLOAD, SECOND, momentum=MOMENTUM)
    np.testing.assert_allclose(control.dipole, UNLOADING, rtol=1e-13)
    np.testing.assert_allclose(control.feedforward_torque, -MAGNETIC_TORQUE, rtol=1e-13)


@given(vectors, vectors, vectors)
def test_unloading_acts_on_what_of_the_momentum_is_across_the_field(field, momentum, target):
    assume(np.linalg.norm(field) > 0.05)
    field = 5e-5 * field
    control = control_of(
        MagneticMode.UNLOAD, field.tolist(), momentum=momentum, target_momentum=target.tolist(), dipole_limit=1e9
    )
    along = field / np.linalg.norm(field)
    across = (momentum - target) - along * (along @ (momentum - target))
    np.testing.assert_allclose(control.feedforward_torque, 0.002 * across, atol=1e-17)
    torque = np.cross(control.dipole, field)
    assert torque @ (momentum - target) <= 1e-17
    assert abs(np.dot(control.dipole, field)) <= 1e-15


@given(vectors, vectors, st.floats(0.01, 10.0))
def test_a_dipole_is_scaled_as_a_whole(field, momentum, limit):
    assume(np.linalg.norm(field) > 0.05 and np.linalg.norm(np.cross(momentum, field)) > 1e-3)
    field = (5e-5 * field).tolist()
    full = np.array(control_of(MagneticMode.UNLOAD, field, momentum=momentum, dipole_limit=1e9).dipole)
    control = control_of(MagneticMode.UNLOAD, field, momentum=momentum, dipole_limit=limit)
    largest = np.abs(full).max()
    assert np.abs(control.dipole).max() == min(largest, limit)
    np.testing.assert_allclose(control.dipole, full * min(1.0, limit / largest), rtol=1e-14)
    limited = control.status == MagneticControlStatus.LIMITED
    assert limited == (largest > limit)


@pytest.mark.parametrize(("fraction", "cycles"), [(0.0, 0), (0.25, 1), (0.3, 2), (0.75, 3), (1.0, 4)])
def test_it_acts_for_a_fraction_of_the_period_and_not_without_a_new_sample(fraction, cycles):
    control = control_of(MagneticMode.UNLOAD, FIRST, momentum=MOMENTUM, active_fraction=fraction)
    acts = [any(control.dipole)]
    for n in range(8):
        control.step(0.25 * n, 0.25)
        assert any(control.dipole) == any(control.feedforward_torque)
        acts.append(any(control.dipole))
    assert acts == [n < cycles for n in range(9)]


def test_a_field_without_a_new_count_is_no_sample():
    control = control_of(MagneticMode.DETUMBLE, FIRST)
    control.measured_field = SECOND
    control.step(0.0, 0.25)
    assert tuple(control.dipole) == (0.0, 0.0, 0.0)


def test_off_is_at_once_and_ends_with_the_next_sample():
    control = control_of(MagneticMode.UNLOAD, SECOND, momentum=MOMENTUM)
    control.mode = MagneticMode.OFF
    control.step(0.0, 0.25)
    assert not any(control.dipole)
    assert not any(control.feedforward_torque)
    control.mode, control.field_count = MagneticMode.UNLOAD, 1
    control.step(0.75, 0.25)
    np.testing.assert_allclose(control.dipole, UNLOADING, rtol=1e-13)


@pytest.mark.parametrize("size", [0.0, 0.99e-6, 1.01e-6])
def test_no_dipole_in_a_weak_field(size):
    control = control_of(MagneticMode.UNLOAD, [0.0, size, 0.0], momentum=MOMENTUM)
    weak = size < 1e-6
    assert (control.status == MagneticControlStatus.WEAK_FIELD) == weak
    assert any(control.dipole) != weak


@pytest.mark.parametrize("wrong", [math.nan, math.inf])
@pytest.mark.parametrize("name", ["measured_field", "wheel_momentum"])
def test_what_is_not_finite_gives_no_dipole_and_is_no_field_to_compare_with(name, wrong):
    """The second sample after it has a dipole again."""
    control = control_of(MagneticMode.DETUMBLE, FIRST, SECOND, dipole_limit=1e3)
    good = getattr(control, name)
    statuses, sizes = [], []
    for n, (values, field) in enumerate([([0.0, wrong, 0.0], SECOND), (good, FIRST), (good, SECOND)]):
        control.measured_field = field
        setattr(control, name, values if name == "wheel_momentum" or n == 0 else field)
        control.field_count += 1
        control.step(2.0 + n, 0.25)
        statuses.append(control.status)
        sizes.append(any(control.dipole))
    bad, fine = MagneticControlStatus.NOT_FINITE, MagneticControlStatus.GOOD
    assert statuses == [bad, fine, fine]
    assert sizes == [False, False, True]
    np.testing.assert_allclose(control.dipole, UNLIMITED, rtol=1e-12)
