"""Names in CSV files that a spreadsheet would interpret as formulas are prefixed with a quote mark.

Truth: the list on OWASP's page on CSV injection; the original name.
"""

from __future__ import annotations

import csv

import pytest
from hypothesis import given
from hypothesis import strategies as some

import perilune
from perilune.common.visible import quote_formula, unquote_formula
from tests.support.builders import component, connection, document, pack, system
from tests.support.foreign.odd_fmu import odd_fmu

NAMES = ["=cmd()", "+x", "-y", "@z"]


@given(some.text() | some.text("'=+-@x"))
def test_names_come_back(name):
    """All of them, so that no two are one column."""
    quoted = quote_formula(name)
    assert not quoted.startswith(("=", "+", "-", "@"))
    assert unquote_formula(quoted) == name


@pytest.mark.flies
def test_a_run_writes_them_and_reads_them_again(tmp_path):
    """Names of components, and of an input of the system."""
    odd_fmu(tmp_path)
    inner = [component(name, "odd", "input u Real; output y Real") for name in NAMES]
    wires = "".join(connection("=in", f"{name}.u") for name in NAMES)
    root = system(*inner, connections=wires, declared="input =in Real")
    path = pack(tmp_path / "s.ssp", tmp_path, document(root, stop=1.0, step=0.25))
    values = tmp_path / "inputs.csv"
    values.write_text("time,'=in\n0,2\n1,2\n")
    flight = perilune.simulate(path, input=values)
    assert flight["=in"][-1] == 2.0
    flight.write(tmp_path / "flight.csv")
    with (tmp_path / "flight.csv").open(newline="") as text:
        names = next(csv.reader(text))
    assert {f"'{name}.y" for name in NAMES} <= set(names)
    assert not [name for name in names if name.startswith(("=", "+", "-", "@"))]
