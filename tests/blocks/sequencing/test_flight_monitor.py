"""Flight monitor: the end of a flight, compared with its definition case by case.

Truth: the definition (guidance finished, slow inside the altitude band, or on the ground), evaluated with Python's
any() over random flights.
"""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.sequencing.flight_monitor import FlightMonitor
from tests.support.lengths import either

moments = st.tuples(st.booleans(), st.integers(-1, 5).map(lambda k: 500.0 * k), st.integers(0, 10).map(float))


def see(monitor, finished, altitude, speed):
    monitor.guidance_finished, monitor.altitude, monitor.speed = finished, altitude, speed


@pytest.mark.parametrize("handover_speed", [0.0, 6.0])
@given(flight=st.lists(moments, min_size=1, max_size=6))
@settings(max_examples=either(200, 50), deadline=None)
def test_outputs_are_latched_conditions(handover_speed, flight):
    monitor = FlightMonitor(handover_speed=handover_speed)
    for n, moment in enumerate(flight):
        see(monitor, *moment)
        if n == 0:
            monitor.initialize()
        else:
            monitor.step(0.1 * n, 0.1)
        observed = flight[: n + 1]
        handed_over = any(1200.0 <= altitude <= 1800.0 and speed < handover_speed for _, altitude, speed in observed)
        grounded = any(altitude <= 0.0 for _, altitude, _ in observed)
        assert monitor.handed_over == handed_over
        assert monitor.ground_contact == grounded
        assert monitor.finished == (handed_over or grounded or any(finished for finished, _, _ in observed))


def test_bounds_of_the_band_belong_to_it():
    for altitude, inside in [(1199.999, False), (1200.0, True), (1800.0, True), (1800.001, False)]:
        monitor = FlightMonitor(handover_speed=6.0, altitude=altitude, speed=5.999)
        monitor.initialize()
        assert monitor.handed_over == inside
    monitor = FlightMonitor(handover_speed=6.0, altitude=1500.0, speed=6.0)
    monitor.initialize()
    assert not monitor.handed_over


def test_declared_starts_do_not_end_a_flight():
    monitor = FlightMonitor()
    monitor.initialize()
    monitor.step(0.0, 0.1)
    assert not monitor.finished
