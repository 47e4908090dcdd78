"""Touchdown monitor, compared with its definition.

Truth: the values at the first contact, taken by numpy, and the five limits evaluated one by one, over random flights.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.sequencing.touchdown_monitor import TouchdownMonitor

numbers = st.floats(-5.0, 5.0)
moments = st.fixed_dictionaries(
    {
        "ground_contact": st.booleans(),
        "vertical_speed": numbers,
        "horizontal_speed": st.floats(0.0, 2.0),
        "tilt": st.floats(0.0, 0.2),
        "angular_rate": st.lists(st.floats(-0.04, 0.04), min_size=3, max_size=3),
        "position": st.lists(st.floats(-8.0, 8.0), min_size=3, max_size=3),
        "site": st.lists(numbers, min_size=3, max_size=3),
    }
)
LATCHED = ("vertical_speed", "horizontal_speed", "tilt", "rate", "distance")


@given(st.lists(moments, min_size=1, max_size=5))
def test_the_first_contact_is_kept_and_judged(flight):
    monitor = TouchdownMonitor()
    first = None
    for n, moment in enumerate(flight):
        for name, value in moment.items():
            setattr(monitor, name, value)
        monitor.step(0.1 * n - 0.1, 0.1) if n else monitor.initialize()
        if first is None and moment["ground_contact"]:
            first = (n, moment)
        assert monitor.contact == (first is not None)
        if first is None:
            assert monitor.contact_time == -1.0
            assert not monitor.within_limits
            continue
        number, observed = first
        expected = [-observed["vertical_speed"], observed["horizontal_speed"], observed["tilt"]]
        expected += [np.linalg.norm(observed["angular_rate"])]
        expected += [np.linalg.norm(np.subtract(observed["position"], observed["site"]))]
        assert [getattr(monitor, f"contact_{name}") for name in LATCHED] == pytest.approx(expected)
        assert monitor.contact_time == pytest.approx(0.1 * number)
        limits = [3.0, 1.0, math.radians(5.0), math.radians(2.0), 10.0]
        assert monitor.within_limits == all(np.array(expected) <= limits)
