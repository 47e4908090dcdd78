"""Rows of the spacecraft benchmark simulate the options that they name.

Truth: the pressure of sunlight on plates; the height of the orbits.
"""

import numpy as np
import pytest

from benchmarks.spacecraft.steps import ROWS, STEPS, plant
from perilune.analysis.runtime.flight.simulation import Simulation

MASS, PRESSURE, AREA = 50.0, 1361.0 / 299792458.0, 1.0  # kg, N/m2, m2: two plates or three are in light
NEWTONS = {  # smallest and largest force but for gravity
    "gravity to degree 0, nothing else": (0.0, 0.0),
    "degree 8, dipole in a field to degree 13": (0.0, 0.0),
    "degree 8, six plates in light": (0.3 * PRESSURE * AREA, 3.0 * PRESSURE * AREA),
    "about the Moon, `moon.ssv`": (0.3 * PRESSURE * AREA, 3.0 * PRESSURE * AREA),
}


@pytest.mark.parametrize("name", NEWTONS)
def test_a_row_flies_with_what_it_says(fmus, name):
    with Simulation(plant(*ROWS[name])) as simulation:
        flight = simulation.fly()
    force = MASS * np.linalg.norm(flight["spacecraft.specific_force"][1:], axis=1)
    lower, upper = NEWTONS[name]
    assert np.all((force >= lower) & (force <= upper))
    distance = np.linalg.norm(flight["spacecraft.position"], axis=1)
    radius = 1837400.0 if "Moon" in name else 6878137.0
    assert np.all(np.abs(distance - radius) < 2e3)
    assert len(flight.time) == STEPS + 1
