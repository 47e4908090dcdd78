"""Clipping of lines to a picture, and lines hidden by the ground.

Truth: many points of the line, each compared with the edges of the picture or with the ground.
"""

import math
from itertools import pairwise

import numpy as np
import pytest

from perilune.analysis.documents.scene.clipping import LEAST_DEPTH, WIDER, clip_polygon, visible_stretches
from perilune.analysis.documents.scene.ground import Ground

TANGENT, ASPECT = 0.36, 1.5
FINE = np.linspace(0.0, 1.0, 4001)[:, None]


def in_picture(points):
    right, up, depth = points.T
    edge = WIDER * TANGENT * depth
    return (depth >= LEAST_DEPTH) & (np.abs(right) <= ASPECT * edge) & (np.abs(up) <= edge)


def test_stretches_are_as_long_as_what_is_in_the_picture():
    random = np.random.default_rng(1)
    for path in random.uniform(-10.0, 10.0, size=(50, 4, 3)):
        stretches = visible_stretches(path, TANGENT, ASPECT)
        length = sum(np.linalg.norm(np.diff(stretch, axis=0), axis=1).sum() for stretch in stretches)
        expected = 0.0
        for start, end in pairwise(path):
            inside = in_picture(start + FINE * (end - start)).mean()
            expected += inside * np.linalg.norm(end - start)
        assert length == pytest.approx(expected, abs=0.05)


def test_a_path_is_interrupted_where_it_is_unknown_and_nowhere_else():
    path = np.stack([np.linspace(-1.0, 1.0, 9), np.zeros(9), np.full(9, 10.0)], axis=1)
    (whole,) = visible_stretches(path, TANGENT, ASPECT)
    assert whole == pytest.approx(path)
    path[4] = np.nan
    before, after = visible_stretches(path, TANGENT, ASPECT)
    assert len(before) == len(after) == 4


def test_a_polygon_around_the_picture_becomes_the_picture():
    wide = np.array([[-100.0, -100.0, 5.0], [100.0, -100.0, 5.0], [100.0, 100.0, 5.0], [-100.0, 100.0, 5.0]])
    clipped = clip_polygon(wide, TANGENT, ASPECT)
    assert np.abs(clipped[:, :2]).max(axis=0) == pytest.approx([5.0 * WIDER * TANGENT * ASPECT, 5.0 * WIDER * TANGENT])
    assert len(clip_polygon(-wide, TANGENT, ASPECT)) == 0  # behind the camera


@pytest.mark.parametrize("radius", [100.0, math.inf])
def test_the_ground_hides_what_is_behind_it(radius):
    random = np.random.default_rng(2)
    ground = Ground(np.array([10.0, 0.0, -20.0]), radius, np.array([0.0, 1.0, 0.0]))
    eye = np.array([0.0, 0.0, 150.0])
    points = random.uniform(-300.0, 300.0, size=(60, 3))
    hidden = ground.hides(eye, points)
    assert 10 < hidden.sum() < 50
    for point, is_hidden in zip(points, hidden, strict=True):
        lowest = min(ground.height(each) for each in eye + FINE[::20] * (point - eye))
        if abs(lowest) > 3.0:
            assert is_hidden == (lowest < 0.0)
