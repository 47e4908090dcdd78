"""Random systems in the interpreted loop, also for `make fuzz`. Truth: the rows of the reference loop, to the bit."""

from hypothesis import HealthCheck, settings

from tests.support.graphs.random_systems import any_flight
from tests.support.lengths import either


def test_rows_and_status(tiny_folder, tmp_path):
    examples = settings(max_examples=either(5_000, 40), deadline=None, suppress_health_check=[HealthCheck.too_slow])
    examples(any_flight(tiny_folder, tmp_path))()
