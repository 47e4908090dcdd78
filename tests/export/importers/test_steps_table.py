"""The table of steps in docs/use_elsewhere.md against the FMUs: all under `make long`, else some of each form.

Truth: FMPy's calls, and the counts of the catalogue.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.importer_steps import FORMS, blocks_of, failures, passed_row, samples_row
from perilune.fmus_src.export.compilers import local_platform
from tests.support.lengths import either
from tests.support.native.building import COMPILED

PAGE = Path(__file__).parents[3] / "docs" / "use_elsewhere.md"
EVERY = {"native": either(1, 12), "python": either(1, 40), "fmi3": either(1, 4)}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.usefixtures("fmus")
def test_fmus_take_the_steps_that_the_page_says(form: str) -> None:
    if form == "fmi3" and local_platform(3) is None:
        pytest.skip("FMI 3.0 libraries are not compiled for this system")
    blocks = [block for block in blocks_of(form) if form != "fmi3" or block.fmu_name in COMPILED]
    assert failures(form, blocks[:: EVERY[form]]) == {}
    assert passed_row(form, {}) in PAGE.read_text(encoding="utf-8").splitlines()


def test_the_page_says_how_many_fmus_take_several_samples_in_a_step() -> None:
    assert samples_row() in PAGE.read_text(encoding="utf-8").splitlines()
