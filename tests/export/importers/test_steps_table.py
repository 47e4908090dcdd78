"""FMUs accept communication steps of any length (docs/use_elsewhere.md): all FMUs under `make long`, else some.

Truth: the results of calls by FMPy.
"""

from __future__ import annotations

import pytest

from benchmarks.importer_steps import FORMS, blocks_of, failures
from perilune.fmus_src.export.compilers import local_platform
from tests.support.lengths import either
from tests.support.native.building import COMPILED

EVERY = {"native": either(1, 20), "python": either(1, 60), "fmi3": either(1, 8)}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.usefixtures("fmus")
def test_fmus_take_steps_of_any_length(form: str) -> None:
    if form == "fmi3" and local_platform(3) is None:
        pytest.skip("FMI 3.0 libraries are not compiled for this system")
    blocks = [block for block in blocks_of(form) if form != "fmi3" or block.fmu_name in COMPILED]
    assert failures(form, blocks[:: EVERY[form]]) == {}
