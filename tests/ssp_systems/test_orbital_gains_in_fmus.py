"""Gains computed by the orbital FMUs at initialisation, for random inertia, sample period and poles (1e-9).

Truth: `perilune.modal` with matrices from tests/support/loops/exact_orbital.py, independent of the blocks' kernels.
"""

import numpy as np
import pytest
from scipy.linalg import expm

from perilune import modal
from perilune.analysis.runtime.instances.instance import instantiate
from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.common.paths import shipped_fmu
from tests.support.loops.exact_orbital import linear_matrix

pytestmark = pytest.mark.usefixtures("fmus")
DRAWS = range(20)
C = np.delete(np.eye(6), 1, axis=0)
PLACES = [[f"[{row + 1},{column + 1}]" for column in range(9)] for row in range(9)]


def draw_case(number):
    """Draw inertia (kg m2), tick (s) and poles (1/s)."""
    random = np.random.default_rng(number)
    root = random.normal(size=(3, 3))
    inertia = 2000.0 * (root @ root.T + 4.0 * np.eye(3))
    return inertia, random.uniform(0.1, 1.0), random.uniform(0.02, 0.3, 3), random.uniform(0.1, 0.5, 3)


class Fmu:
    """A native FMU, initialised with parameters."""

    def __init__(self, name, **parameters):
        path = shipped_fmu(name, "native")
        fmu = load_fmu(path.read_bytes(), str(path))
        self.instance = instantiate(fmu, name)
        self.references = {key: variable.reference for key, variable in fmu.variables.items()}
        slave = self.instance.slave
        for key, value in parameters.items():
            values = np.ravel(value)
            names = [key] if np.ndim(value) == 0 else [f"{key}{PLACES[i // 3][i % 3]}" for i in range(9)]
            if np.ndim(value) == 1:
                names = [f"{key}[{i + 1}]" for i in range(len(values))]
            slave.setReal([self.references[each] for each in names], values.tolist())
        slave.setupExperiment(startTime=0.0)
        slave.enterInitializationMode()
        slave.exitInitializationMode()

    def matrix(self, name, rows, columns):
        names = [f"{name}{PLACES[i][k]}" for i in range(rows) for k in range(columns)]
        values = self.instance.slave.getReal([self.references[each] for each in names])
        return np.reshape(values, (rows, columns))


@pytest.mark.parametrize("number", DRAWS)
def test_the_modal_regulator(number):
    """Levels of angles and rates in their own coordinates."""
    inertia, tick, _, poles = draw_case(number)
    angles, rates = poles, 1.5 * poles[::-1]
    fmu = Fmu("orbital_modal_control", inertia=inertia, sample_period=tick, angle_poles=angles, rate_poles=rates)
    driven = np.vstack([np.zeros((3, 3)), np.linalg.inv(inertia)])
    columns = np.eye(6)
    placed = modal.place_levels(
        linear_matrix(inertia), driven, [-np.diag(rates), -np.diag(angles)], bases=[columns[:, 3:], columns[:, :3]]
    )
    actual = np.hstack([fmu.matrix("angle_gain", 3, 3), fmu.matrix("rate_gain", 3, 3)])
    assert np.abs(actual + placed.gain).max() < 1e-9 * np.abs(placed.gain).max()


@pytest.mark.parametrize("number", DRAWS)
def test_the_regulator_that_feeds_the_derivative_back(number):
    """A gain on the state times the inverse of its closed loop, and the torque of the products of inertia."""
    inertia, tick, _, poles = draw_case(number)
    angles, rates, turn = poles, 1.5 * poles[::-1], 0.1 * np.array([[0, 0, -1], [0, 0, 0], [1, 0, 0]])
    fmu = Fmu(
        "orbital_derivative_control",
        inertia=inertia,
        sample_period=tick,
        angle_poles=angles,
        rate_poles=rates,
        coupling=0.1,
    )
    driven, columns, motion = np.vstack([np.zeros((3, 3)), np.linalg.inv(inertia)]), np.eye(6), linear_matrix(inertia)
    levels = [turn - np.diag(rates), turn - np.diag(angles)]
    placed = modal.place_levels(motion, driven, levels, bases=[columns[:, 3:], columns[:, :3]])
    expected = -placed.gain @ np.linalg.inv(placed.closed_loop)
    actual = np.hstack([fmu.matrix("angle_gain", 3, 3), fmu.matrix("rate_gain", 3, 3)])
    assert np.abs(actual - expected).max() < 1e-9 * np.abs(expected).max()


@pytest.mark.parametrize("number", DRAWS)
def test_the_continuous_observer(number):
    inertia, tick, poles, _ = draw_case(number)
    slow, fast = poles[0], 3.0 * poles[1] + 0.1
    fmu = Fmu("orbital_observer_continuous", inertia=inertia, sample_period=tick, yaw_pole=slow, measured_pole=fast)
    placed = modal.place_levels(linear_matrix(inertia).T, C.T, [-fast * np.eye(5), [[-slow]]]).gain.T
    assert np.abs(fmu.matrix("gain", 6, 5) - placed).max() < 1e-9 * np.abs(placed).max()


@pytest.mark.parametrize("number", DRAWS)
def test_the_discrete_observer(number):
    """Ad L is the dual placement for (Ad, C)."""
    inertia, tick, poles, _ = draw_case(number)
    slow, fast = poles[0], 3.0 * poles[1] + 0.1
    fmu = Fmu("orbital_observer_discrete", inertia=inertia, sample_period=tick, yaw_pole=slow, measured_pole=fast)
    sampled = expm(linear_matrix(inertia) * tick)
    desired = [np.exp(-fast * tick) * np.eye(5), [[np.exp(-slow * tick)]]]
    placed = np.linalg.solve(sampled, modal.place_levels(sampled.T, C.T, desired).gain.T)
    assert np.abs(fmu.matrix("gain", 6, 5) - placed).max() < 1e-9 * np.abs(placed).max()
