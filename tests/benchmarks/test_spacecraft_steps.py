"""The rows of the benchmark of spacecraft are those of its page, and fly what they say.

Truth: the page; the pressure of sunlight on plates; the height of the orbits.
"""

import re

import numpy as np
import pytest

from benchmarks.spacecraft.steps import REPEATS, ROWS, STAGES, STEPS, plant
from perilune.analysis.runtime.flight.simulation import Simulation
from tests.support.space.pointing_page import section

HEADING = "What it costs"
MASS, PRESSURE, AREA = 50.0, 1361.0 / 299792458.0, 1.0  # kg, N/m2, m2: two plates or three are in light
NEWTONS = {  # smallest and largest force but for gravity
    "gravity to degree 0, nothing else": (0.0, 0.0),
    "degree 8, dipole in a field to degree 13": (0.0, 0.0),
    "degree 8, six plates in light": (0.3 * PRESSURE * AREA, 3.0 * PRESSURE * AREA),
    "about the Moon, `moon.ssv`": (0.3 * PRESSURE * AREA, 3.0 * PRESSURE * AREA),
}


def test_the_table_has_the_rows_of_the_benchmark():
    rows = re.findall(r"^\| (.*) \| ([\d.]+) \| ([\d.]+) \|$", section(HEADING), re.MULTILINE)
    assert [name for name, *_ in rows] == list(ROWS)
    for _, step, stage in rows:
        assert float(stage) == pytest.approx(float(step) / STAGES, abs=0.006)
    assert f"shortest of {REPEATS} flights of {STEPS} steps" in section(HEADING)


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
