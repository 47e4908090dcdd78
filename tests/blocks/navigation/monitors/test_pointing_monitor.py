"""Pointing monitor of a satellite.

Truth: a rotation about the boresight does not move it; spherical geometry; scipy's rotation vectors.
"""

import math

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.navigation.pointing_monitor import PointingMonitor

seeds = st.integers(0, 2**32 - 1)


def quaternion(rotation, sign=1.0):
    return (sign * rotation.as_quat(scalar_first=True)).tolist()


def monitor_of(true, reference, estimate, boresight):
    monitor = PointingMonitor(
        boresight=boresight.tolist(),
        quaternion=quaternion(true),
        reference_quaternion=quaternion(reference, -1.0),
        estimated_quaternion=quaternion(estimate, -1.0),
    )
    monitor.initialize()
    return monitor


@given(seeds, st.floats(0.0, math.pi), st.floats(-math.pi, math.pi))
def test_half_cone_is_the_tilt_of_the_boresight_whatever_it_turns_about_itself(seed, tilt, roll):
    random = np.random.default_rng(seed)
    reference, boresight = Rotation.random(rng=random), random.normal(size=3)
    assume(np.linalg.norm(boresight) > 0.1)
    direction = boresight / np.linalg.norm(boresight)
    across = np.cross(direction, random.normal(size=3))
    across /= np.linalg.norm(across)
    true = reference * Rotation.from_rotvec(tilt * across) * Rotation.from_rotvec(roll * direction)
    monitor = monitor_of(true, reference, true, boresight)
    np.testing.assert_allclose(monitor.half_cone, tilt, atol=1e-14)
    # cos(angle/2) = cos(tilt/2) cos(roll/2) for axes across each other
    whole = 2.0 * math.acos(min(1.0, math.cos(0.5 * tilt) * math.cos(0.5 * roll)))
    np.testing.assert_allclose(np.linalg.norm(monitor.attitude_error), whole, atol=3e-8)


@given(seeds, st.floats(0.0, 3.1))
def test_knowledge_error_is_the_rotation_from_truth_to_estimate(seed, angle):
    """In body axes, whatever the reference."""
    random = np.random.default_rng(seed)
    true, reference, axis = Rotation.random(rng=random), Rotation.random(rng=random), random.normal(size=3)
    error = angle * axis / np.linalg.norm(axis)
    monitor = monitor_of(true, reference, true * Rotation.from_rotvec(error), np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(monitor.knowledge_error, error, atol=1e-13)
