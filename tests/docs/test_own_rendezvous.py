"""Blocks of docs/guides/own_rendezvous.md, compared with independent mathematics, and its system as system.toml.

Truth: the exponential of Clohessy and Wiltshire's matrix by scipy, written here; `filterpy.kalman.ExtendedKalmanFilter`
with the Jacobian by the unit vectors of spherical coordinates; the declared standard deviations of the noise.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from filterpy.common import Q_continuous_white_noise
from filterpy.kalman import ExtendedKalmanFilter
from scipy.linalg import block_diag, expm

from perilune.analysis.cli import main
from perilune.fmus_src.catalogue import blocks_in_file
from perilune.fmus_src.export.judge.subset import check
from perilune.fmus_src.kernel.vector_types import vector
from tests.support.documented import page_text, saved_files

PAGE = page_text("docs/guides/own_rendezvous.md")
FILES = dict(saved_files(PAGE))
N, MASS, H = 0.0011, 100.0, 1.0  # rad/s, kg, s: what the page declares
RANGE_SIGMA, ANGLE_SIGMA, DENSITY = 0.1, 1e-3, 1e-7
START = np.array([30.0, -960.0, -20.0, 0.05, 0.0, -0.02])
RATES = np.zeros((6, 6))
RATES[:3, 3:] = np.eye(3)
RATES[3, 0], RATES[3, 4], RATES[4, 3], RATES[5, 2] = 3.0 * N * N, 2.0 * N, -2.0 * N, -N * N
STEPS = 600


def transition(t):
    """Return position and velocity, and their changes by an acceleration held for t (s)."""
    whole = np.zeros((9, 9))
    whole[:6, :6], whole[3:6, 6:] = RATES, np.eye(3)
    phi = expm(whole * t)
    return phi[:6, :6], phi[:6, 6:]


def measure(x):
    """Return range, azimuth and elevation of the target from the chaser."""
    up, along, normal = -x[:3]
    return np.array([np.linalg.norm(x[:3]), np.arctan2(up, along), np.arctan2(normal, np.hypot(up, along))])


def jacobian(x):
    """Return derivatives of `measure`: the unit vectors of spherical coordinates over the target's motion by an
    angle."""
    distance, azimuth, elevation = measure(x)
    sa, ca, se, ce = np.sin(azimuth), np.cos(azimuth), np.sin(elevation), np.cos(elevation)
    rows = [[ce * sa, ce * ca, se], [ca / (distance * ce), -sa / (distance * ce), 0.0]]
    rows.append([-se * sa / distance, -se * ca / distance, ce / distance])
    return np.hstack([-np.array(rows), np.zeros((3, 3))])


@pytest.fixture(scope="module")
def blocks(tmp_path_factory):
    """Return the classes of the page by name, and the module."""
    path = tmp_path_factory.mktemp("page") / "own_rendezvous_blocks.py"
    path.write_text(FILES["rendezvous/blocks.py"], encoding="utf-8")
    return {block.__name__: block for block in blocks_in_file(path)}


def test_all_are_kernels_and_the_system_is_short(blocks):
    assert len(blocks) == 4
    for block in blocks.values():
        assert not check(block)
    assert len(FILES["rendezvous/system.toml"].splitlines()) <= 30


def test_the_closed_form_is_the_exponential_of_the_equations(blocks):
    closed = blocks["RelativeNavigation"].predict.__globals__["transition"]
    for t in (1.0, 100.0, 2000.0, 5712.0):  # to a revolution
        expected = transition(t)[0]
        assert abs(np.array(closed(N, t)) - expected).max() < 1e-12 * abs(expected).max()


def test_the_plant_follows_it_under_any_force(blocks):
    random, plant = np.random.default_rng(1), blocks["RelativeMotion"]()
    plant.initial_position, plant.initial_velocity = vector(*START[:3]), vector(*START[3:])
    plant.initialize()
    phi, gained = transition(H)
    expected, spent = START, 0.0
    for k in range(STEPS):
        force = random.normal(size=3)
        plant.force = vector(*force)
        plant.step(k * H, H)
        expected, spent = phi @ expected + gained @ force / MASS, spent + H * np.linalg.norm(force) / MASS
        assert np.linalg.norm(np.array(plant.position) - expected[:3]) < 1e-12 * np.linalg.norm(expected[:3])
    assert plant.range == pytest.approx(np.linalg.norm(expected[:3]), rel=1e-12)
    assert plant.speed == pytest.approx(np.linalg.norm(expected[3:]), rel=1e-11)
    assert plant.delta_v == pytest.approx(spent, rel=1e-12)


def test_the_sensor_measures_the_geometry_with_errors_as_declared(blocks):
    sensor = blocks["RangeBearing"]()
    sensor.position = vector(*START[:3])
    sensor.initialize()
    samples = []
    for k in range(4000):
        sensor.step(k * H, H)
        samples.append([sensor.range, sensor.azimuth, sensor.elevation])
    errors = (np.array(samples) - measure(START)) / [RANGE_SIGMA, ANGLE_SIGMA, ANGLE_SIGMA]
    assert abs(errors.mean(axis=0)).max() < 4.0 / np.sqrt(len(errors))
    assert abs(errors.std(axis=0) - 1.0).max() < 4.0 / np.sqrt(2.0 * len(errors))


def test_the_filter_is_filterpys(blocks):
    random, block = np.random.default_rng(2), blocks["RelativeNavigation"]()
    other = ExtendedKalmanFilter(dim_x=6, dim_z=3)
    other.x = np.array([0.0, -1000.0, 0.0, 0.0, 0.0, 0.0])
    other.P = block_diag(2500.0 * np.eye(3), 0.01 * np.eye(3))
    other.R = np.diag([RANGE_SIGMA, ANGLE_SIGMA, ANGLE_SIGMA]) ** 2
    other.Q = np.kron(Q_continuous_white_noise(2, H, DENSITY), np.eye(3))
    other.F = transition(H)[0]
    true = START
    for k in range(STEPS + 1):
        force = random.normal(size=3)
        if k:
            true = transition(H)[0] @ true + transition(H)[1] @ force / MASS
            other.x = other.F @ other.x + np.concatenate([0.5 * H * H * force, H * force]) / MASS
            other.P = other.F @ other.P @ other.F.T + other.Q
        sample = measure(true) + random.normal(size=3) * [RANGE_SIGMA, ANGLE_SIGMA, ANGLE_SIGMA]
        block.range, block.azimuth, block.elevation = sample.tolist()
        if k:
            block.force = vector(*force)
            block.step((k - 1) * H, H)
        else:
            block.initialize()
        other.update(sample, HJacobian=jacobian, Hx=measure)
        actual = np.array(block.estimate).ravel()
        assert abs(actual - other.x).max() < 1e-9
        assert abs(np.array(block.covariance) - other.P).max() < 1e-9 * other.P.max()
    assert abs(actual[:3] - true[:3]).max() < 5.0 * np.sqrt(np.diag(other.P)[:3].max())
    assert block.status == 0


@pytest.mark.usefixtures("fmus")
def test_what_is_wrong_has_the_line_of_the_page(tmp_path, monkeypatch, capsys):
    """Before the export, too: the file that has the blocks is named."""
    monkeypatch.chdir(tmp_path)
    for name, content in FILES.items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(content, encoding="utf-8")
    toml = "rendezvous/system.toml"
    assert main(["compose", toml]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 4
    for line in lines:
        assert line.endswith(" is built; perilune export rendezvous/blocks.py builds it")
    assert main(["export", "rendezvous/blocks.py", "--flavour", "python"]) == 0
    before, after = "sensor.range -> navigation.range", "sensor.range -> navigation.azimuth"
    Path(toml).write_text(FILES[toml].replace(before, after), encoding="utf-8")
    assert main(["compose", toml]) == 2
    assert f"    {capsys.readouterr().err.splitlines()[0].removeprefix('perilune: ')}\n" in PAGE
