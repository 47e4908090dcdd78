"""FMUs that request the end of the simulation, as Stair of the Reference FMUs: a regular end, at the FMU's time.

Truth: FMPy's simulate_fmu, to the last bit; results by hand for connected components.
"""

import fmpy
import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.options.fault import parse_fault
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.builders import component, connection, document, fly, pack, system
from tests.support.foreign.odd_fmu import odd_fmu, odd_system


@pytest.mark.parametrize("end", [0.6, 0.5, 0.1, 1e-9, 0.99])
def test_the_rows_are_those_of_fmpy(tmp_path, end):
    result = fly(odd_system(tmp_path, ENDS_AT=end))
    truth = fmpy.simulate_fmu(
        str(tmp_path / "odd.fmu"), stop_time=1.0, output_interval=0.25, output=["y", "tolerance", "length"]
    )
    assert (result.status, result.complete) == ("terminated", True)
    assert result.message == f"odd asked for termination at t = {end:g} s"
    np.testing.assert_array_equal(result.time, truth["time"])
    for name in ("y", "tolerance", "length"):
        np.testing.assert_array_equal(result[f"odd.{name}"], truth[name])


@pytest.mark.parametrize(("said", "last"), [("nan", "nan"), ("inf", "inf"), ("0.25", "0.25"), ("0.875", "0.875")])
def test_an_end_at_a_time_outside_its_step_is_a_failure(tmp_path, said, last):
    """It is asked for in the step from 0.5 s to 0.75 s."""
    flight = perilune.simulate(odd_fmu(tmp_path, ENDS_AT=0.6, SAYS_TIME=said))
    outside = f"lastSuccessfulTime {last} s, which is not in its step from 0.5 s to 0.75 s"
    message = f"odd: fmi2DoStep asked for termination with status discard with {outside}: no message in its log"
    assert (flight.status, flight.message, flight.time[-1]) == ("failed", message, 0.5)


def test_every_nth_row_and_the_last(tmp_path):
    prepared = prepare_system(odd_system(tmp_path, ENDS_AT=0.6), SystemOptions())
    with Simulation(prepared) as simulation:
        for every in (1, 2, 3, 100):
            expected = [*[0.0, 0.25, 0.5][::every], 0.6]
            assert simulation.fly(every=every).time.tolist() == expected


@pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])
def test_what_is_connected_has_the_last_values(tiny_folder, tmp_path, algorithm):
    odd_fmu(tmp_path, ENDS_AT=0.6)
    (tmp_path / "gain.fmu").write_bytes((tiny_folder / "native" / "gain.fmu").read_bytes())
    parts = component("odd", "odd", "output y Real"), component("gain", "gain", "input u Real m; output y Real m")
    wires = connection("odd.y", "gain.u") + connection("odd.y", "out")
    root = system(*parts, connections=wires, declared="output out Real")
    path = pack(tmp_path / "s.ssp", tmp_path, document(root))
    result = fly(path, algorithm=algorithm)
    assert (result.status, result.time[-1]) == ("terminated", 0.6)
    np.testing.assert_allclose(result["odd.y"], 3.0 * result.time, rtol=1e-13)
    np.testing.assert_array_equal(result["gain.u"], result["odd.y"])
    np.testing.assert_array_equal(result["out"], result["odd.y"])
    faulty = fly(path, [parse_fault("gain.u=override:7@0.55")], algorithm=algorithm)
    assert faulty["gain.u"][-2:].tolist() == [result["odd.y"][-2], 7.0]
    assert faulty["out"][-1] == result["odd.y"][-1]


def test_a_good_end_on_the_command_line(tmp_path, capsys):
    path = odd_system(tmp_path, ENDS_AT=0.6)
    assert main(["run", str(path), "--require", "time <= 0.6", "--report", str(tmp_path / "page.html")]) == 0
    actual = capsys.readouterr()
    assert "odd: terminated at t = 0.6 s, 4 samples" in actual.out
    assert actual.err == ""
    assert "Terminated by an FMU (status" in (tmp_path / "page.html").read_text()
