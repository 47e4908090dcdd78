"""Random systems in the interpreted loop, compared with the reference loop to the bit, for any end of the simulation.

Varied are connections of all types with transformations and mappings, faults, components with longer steps, a parameter
driven over time, recorded variables, and both algorithms.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.runtime.system.series import read_series
from tests.fuzz.documents import Target
from tests.support.builders import pack
from tests.support.flights.reference import assert_same
from tests.support.graphs.small_blocks import graphs

OVER_TIME = {"time": [0.0, 0.5, 0.5, 1.5], "ramp0.slope": [1.0, -2.0, 4.0, 0.1]}


def any_flight(fmus: Path, folder: Path) -> Target:
    """Return the test of systems of the ``fmus`` in native flavour, packed in ``folder``."""

    @given(graph=graphs(), paces=st.lists(st.integers(1, 4), min_size=8, max_size=8), is_driven=st.booleans())
    def has_the_rows_of_the_reference(graph: Any, paces: list[int], is_driven: bool) -> None:
        ssd, values, faults, recorded, algorithm = graph
        path = pack(folder / "reference.ssp", fmus / "native", ssd)
        series = read_series(OVER_TIME) if is_driven else None
        prepared = prepare_system(path, SystemOptions(set=values, algorithm=algorithm), series=series)
        periods = {name: pace for name, pace in zip(prepared.network.fmus, paces, strict=False) if pace > 1}
        assert_same(replace(prepared, periods=periods), faults, recorded)

    return has_the_rows_of_the_reference
