"""Blocks in FMI 3.0 give the bits of FMI 2.0: each block's check, simulated by FMPy with the same inputs in both.

All variables at all points and the words of the complete state are compared. `make long` covers every block, `make
test` some blocks that together have all kinds of variables.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest

from perilune.common.paths import shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.evidence.check import read_check
from perilune.fmus_src.export.compilers import local_platform
from tests.support.lengths import either
from tests.support.native.building import COMPILED, NATIVE, REPRESENTATIVE, fmi3_fmu
from tests.support.native.flights import fly_fmi2, fly_fmi3

pytestmark = pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")
HEADER = 48  # bytes before the variables: a hash that tells FMUs apart, mode, whether settled, samples, times


@pytest.mark.parametrize("name", COMPILED[:: either(1, 3)])
def test_a_block_flies_as_in_fmi_2(name: str, tmp_path: Path) -> None:
    check = read_check(catalogue()[name])
    assert check is not None
    rows = list(csv.DictReader(io.StringIO(check.table.decode())))
    inputs = [
        {column: float(text) for column, text in row.items() if column not in ("time", *check.tolerances)}
        for row in rows
    ]
    arguments = (check.parameters, inputs, check.step)
    two = fly_fmi2(shipped_fmu(name, "native"), *arguments, tmp_path / "2")
    three = fly_fmi3(fmi3_fmu(catalogue()[name]), *arguments, tmp_path / "3")
    assert len(two.points) == len(three.points) == len(rows)
    for point, (old, new) in enumerate(zip(two.points, three.points, strict=True)):
        assert new.keys() == old.keys()
        for variable, values in old.items():
            assert list(map(repr, map(float, new[variable]))) == list(map(repr, map(float, values))), (point, variable)
    assert three.state[8:] == two.state[8:]
    assert len(three.state) == HEADER + 8 * sum(map(len, two.points[0].values()))


def test_the_share_of_blocks_has_every_kind_of_variable() -> None:
    """Types, dimensions, causalities; records, bundles, enumerations."""
    assert set(REPRESENTATIVE) <= set(NATIVE)
    blocks = [catalogue()[name] for name in REPRESENTATIVE]
    variables = [variable for block in blocks for variable in block.variables.values()]
    assert {variable.type_name for variable in variables} == {"Real", "Integer", "Boolean"}
    assert {variable.causality for variable in variables} == {"parameter", "input", "output", "local"}
    for sort in ("record", "shape", "is_vector", "enumeration"):
        assert any(getattr(variable, sort) for variable in variables), sort
    assert any(block.bundles for block in blocks)
