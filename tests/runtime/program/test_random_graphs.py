"""Random systems by the interpreted loop: the rows of the reference loop to the bit, however the flight ends.

Connections of all types with transformations and mappings, faults, components with longer steps, a parameter driven
over time, what is recorded, both algorithms.
"""

from dataclasses import replace

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.runtime.system.series import read_series
from tests.support.builders import pack
from tests.support.flights.reference import assert_same
from tests.support.graphs.small_blocks import graphs
from tests.support.lengths import either

OVER_TIME = {"time": [0.0, 0.5, 0.5, 1.5], "ramp0.slope": [1.0, -2.0, 4.0, 0.1]}


@settings(max_examples=either(5_000, 40), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(graph=graphs(), paces=st.lists(st.integers(1, 4), min_size=8, max_size=8), is_driven=st.booleans())
def test_rows_and_status(tiny_folder, tmp_path_factory, graph, paces, is_driven):
    ssd, values, faults, wanted, algorithm = graph
    path = pack(tmp_path_factory.getbasetemp() / "reference.ssp", tiny_folder / "native", ssd)
    series = read_series(OVER_TIME) if is_driven else None
    prepared = prepare_system(path, SystemOptions(set=values, algorithm=algorithm), series=series)
    periods = {name: pace for name, pace in zip(prepared.network.fmus, paces, strict=False) if pace > 1}
    assert_same(replace(prepared, periods=periods), faults, wanted)
