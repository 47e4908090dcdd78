"""Shipped systems in every executor: rows of the reference loop, to the bit, with both algorithms and faults.

Truth: the reference loop, which calls FMPy for one variable at a time and uses no instructions.
"""

import fmpy
import pytest

import perilune
from perilune.analysis.runtime.ssp.archive import system_names
from tests.support.flights.reference import assert_same, prepared_for, some_faults
from tests.support.lengths import LONG, either

pytestmark = pytest.mark.usefixtures("fmus")
ALGORITHMS = ("sequential", "jacobi")
STEPS = either(300, 60)
WELL = ("stop_time", "finished")


@pytest.mark.parametrize("algorithm", either(ALGORITHMS, ALGORITHMS[:1]))
@pytest.mark.parametrize("name", system_names())
def test_interpreted(name, algorithm):
    assert assert_same(prepared_for(name, STEPS, algorithm=algorithm), flights=1) in WELL


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("name", either(system_names(), ["lunar_terminal_guidance", "orbital_attitude"]))
def test_with_faults(name, algorithm):
    prepared = prepared_for(name, STEPS, algorithm=algorithm)
    for seed in range(either(10, 1)):
        faults = some_faults(prepared, f"{name} {seed}")
        assert faults
        assert_same(prepared, faults)


@pytest.mark.parametrize("algorithm", either(ALGORITHMS, ALGORITHMS[:1]))
@pytest.mark.parametrize("name", either(system_names(), ["lunar_terminal_guidance"]))
def test_fused(name, algorithm):
    """Compiled for the system with its faults; what they do not change is in the rows before them."""
    prepared = prepared_for(name, STEPS, algorithm=algorithm, flavour="fused")
    assert_same(prepared, some_faults(prepared, name))
    if LONG:
        assert assert_same(prepared) in WELL


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("name", either(system_names(), ["lunar_terminal_guidance"]))
def test_fmi_3(name, algorithm, tmp_path):
    """The same blocks exported for FMI 3.0, whose vectors are arrays."""
    perilune.export(name, fmi=3, platforms=[fmpy.platform_tuple], output=tmp_path / "exported.ssp")
    prepared = prepared_for(tmp_path / "exported.ssp", STEPS, algorithm=algorithm)
    assert prepared.has_fmi3
    assert assert_same(prepared) in WELL
    assert_same(prepared, some_faults(prepared, name))


@pytest.mark.parametrize("name", ["lunar_descent_2d", *either(["lunar_terminal_guidance"], [])])
def test_python_flavour(name):
    prepared = prepared_for(name, STEPS, flavour="python")
    assert not prepared.is_native
    assert assert_same(prepared) in WELL


@pytest.mark.parametrize("name", either(system_names(), ["lunar_terminal_guidance"]))
def test_whole_flights(name):
    """To the system's own end, which for a landing is that of its output `finished`."""
    prepared = prepared_for(name)
    status = assert_same(prepared, flights=1)
    assert status == ("finished" if "finished" in prepared.network.nodes else "stop_time")
