"""Gains that the orbital FMUs make at initialisation, against the modal library: 1e-9, with inertia, tick, poles drawn.

Truth: `perilune.modal` on matrices written out in tests/support/loops/exact_orbital.py, apart from the blocks' kernels.
"""

import numpy as np
import pytest
from scipy.linalg import expm

from perilune import modal
from perilune.analysis.flight.instance import instantiate
from perilune.analysis.system.fmu import load_fmu
from perilune.fmus_src.places import built_fmu
from tests.support.loops.exact_orbital import linear_motion

pytestmark = pytest.mark.usefixtures("fmus")
DRAWS = range(20)
C = np.delete(np.eye(6), 1, axis=0)
PLACES = [[f"[{row + 1},{column + 1}]" for column in range(9)] for row in range(9)]


def drawn(number):
    """Inertia (kg m2), tick (s) and poles (1/s)."""
    random = np.random.default_rng(number)
    root = random.normal(size=(3, 3))
    inertia = 2000.0 * (root @ root.T + 4.0 * np.eye(3))
    return inertia, random.uniform(0.1, 1.0), random.uniform(0.02, 0.3, 3), random.uniform(0.1, 0.5, 3)


class Fmu:
    """A native FMU, initialised with parameters."""

    def __init__(self, name, **parameters):
        path = built_fmu(name, "native")
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
