"""Reference loop, in cases in which the loop in C could differ.

Truth: results by hand from the definitions of faults, of event mode and of the last row.
"""

import shutil

import numpy as np
import pytest

from perilune.analysis.options.fault import parse_fault
from perilune.analysis.runtime.program.opening import fly_reference
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.runtime.system.series import read_series
from tests.support.builders import component, connection, document, pack, system
from tests.support.flights.reference import assert_same
from tests.support.fmi3.reference import reference_fmu
from tests.support.fmi3.strict_pair import pack_strict_pair
from tests.support.foreign.odd_fmu import odd_fmu


@pytest.fixture
def discrete(tiny_folder, tmp_path):
    """Prepare a ramp 1, 0, -1, -2, -3 through a discrete Float64 of an FMU with event mode, at the same time."""
    shutil.copy(reference_fmu(3, "Feedthrough"), tmp_path / "feed.fmu")
    shutil.copy(tiny_folder / "native" / "ramp.fmu", tmp_path / "ramp.fmu")
    passes = "input Float64_discrete_input Real; output Float64_discrete_output Real"
    root = system(
        component("ramp", "ramp", "output y Real"),
        component("feed", "feed", passes),
        connections=connection("ramp.y", "feed.Float64_discrete_input"),
    )
    path = pack(tmp_path / "s.ssp", tmp_path, document(root))
    return prepare_system(path, SystemOptions(set={"ramp.start": 1.0, "ramp.slope": -4.0})), ()


@pytest.fixture
def ended(tmp_path):
    """Prepare an FMU that ends the flight at 0.6 s; its input over time is 1 + t with a bias of 10, its gain 3."""
    series = read_series({"time": [0.0, 1.0], "u": [1.0, 2.0], "gain": [3.0, 3.0]})
    options = SystemOptions(step=0.25, stop_time=1.0)
    return prepare_system(odd_fmu(tmp_path, ENDS_AT=0.6), options, series=series), [parse_fault("odd.u=bias:10@0")]


@pytest.fixture
def frozen(tmp_path):
    """Prepare whole numbers n + 2^53 + 1, of which the receiver counts those that are others, at the one of 0.5 s."""
    return prepare_system(pack_strict_pair(tmp_path)), [parse_fault("sink.wide_in=freeze@0.5")]


@pytest.fixture
def biased(tmp_path):
    """Prepare likewise, each with 1 more than it has, which the next float64 is further away than."""
    return prepare_system(pack_strict_pair(tmp_path)), [parse_fault("sink.wide_in=bias:1@0.5")]


def test_a_discrete_input_that_becomes_0_is_given(discrete):
    prepared, _ = discrete
    assert fly_reference(prepared).signals["feed.Float64_discrete_output"] == [1.0, 0.0, -1.0, -2.0, -3.0]


def test_the_last_row_has_what_the_fmu_was_given(ended):
    rows = fly_reference(*ended)
    assert (rows.status, rows.time) == ("terminated", [0.0, 0.25, 0.5, 0.6])
    assert rows.signals["odd.u"] == [11.0, 11.25, 11.5, 11.5]
    assert rows.signals["odd.gain"] == [3.0] * 4


def test_a_frozen_whole_number_of_64_bits_stays_what_it_was(frozen):
    """Set at the end of a step, the number of its start counts in the next one: from 0.75 s on it is another."""
    assert fly_reference(*frozen).signals["sink.mismatches"] == [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0]


def test_a_bias_on_a_whole_number_of_64_bits_is_exact(biased):
    rows = fly_reference(*biased)
    assert rows.signals["sink.mismatches"] == [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    numbers = np.array([2**53 + 1 + n + (n >= 2) for n in range(9)], dtype=np.int64)
    assert rows.signals["sink.wide_in"] == numbers.astype(float).tolist()


DEFECTS = {
    "ended": "driven inputs get their faults twice in the last row, driven parameters the value without the drive",
    "frozen": "a whole number of 64 bits is what its source has as long as their float64 are equal",
    "biased": "likewise, where a bias is lost in rounding",
}


@pytest.mark.parametrize(
    "case",
    [pytest.param(case, marks=pytest.mark.xfail(reason=reason, strict=True)) for case, reason in DEFECTS.items()],
)
def test_the_loop_in_c(case, request):
    assert_same(*request.getfixturevalue(case))


def test_the_loop_in_c_gives_a_discrete_input_that_becomes_0(discrete):
    assert_same(*discrete)
