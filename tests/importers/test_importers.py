"""FMUs in other importers, and the table of the results of `make importers`.

Truth: FMPy, whose values libcosim, Ecos and the FMU Manipulation Toolbox reproduce to the last bit.
"""

from __future__ import annotations

import importlib.util

import pytest

from perilune.analysis.runtime.ssp.archive import system_names
from perilune.common.paths import shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from tests.support.lengths import either
from tests.support.native.building import NATIVE

from .__main__ import BEGIN, END, PAGE
from .masters import MASTERS
from .trial import try_importers

HERE = [name for name in MASTERS if name != "Ecos" or importlib.util.find_spec("ecospy")]


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("flavour", either(["native", "python"], ["native"]))
@pytest.mark.parametrize(
    "name", either(["terrain_camera", "orbital_filter", "spherical_moon_lander"], ["terrain_camera"])
)
def test_importers_agree(name: str, flavour: str) -> None:
    outcomes = try_importers(shipped_fmu(name, flavour), HERE)
    assert [outcome.problem for outcome in outcomes] == [""] * len(HERE)


def test_the_table_has_every_fmu() -> None:
    text = PAGE.read_text(encoding="utf-8")
    rows = text[text.index(BEGIN) + len(BEGIN) : text.index(END)].splitlines()
    assert rows[0] == f"| FMUs | {' | '.join(MASTERS)} |"
    counts = {
        row.split(" | ")[0].strip("| "): {cell.split()[2] for cell in row.strip("| ").split(" | ")[1:]}
        for row in rows[2:]
    }
    assert counts == {
        "FMI 2.0, native": {str(len(NATIVE))},
        "FMI 2.0, Python": {str(len(catalogue()))},
        "FMI 3.0, native": {str(len(NATIVE))},
        "systems as one FMU": {str(len(system_names()))},
    }
