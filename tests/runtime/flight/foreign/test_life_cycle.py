"""Foreign FMUs over several simulations: tolerance, terminate, reset, and a single instance.

Truth: the closed form of the odd FMU, y = t (gain u + 2) with u = 0.5; the letters that it writes for each call, with !
before a call that FMI 2.0's state machine forbids; FMPy's simulate_fmu.
"""

import fmpy
import numpy as np
import pytest

import perilune
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.instances.renewal import Renewal, ResetVerdict
from perilune.analysis.runtime.instances.reset_check import reset_verdict
from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import component, document, fly, pack, system
from tests.support.foreign.odd_fmu import odd_fmu, odd_system

GOOD = (
    {},
    {"FLOAT32": True},
    {"LOSES_EARLY": True},
    {"UNREADABLE_GAIN": 3},
    {"ENDS_AT": 0.6},
)
BAD = (
    ({"KEEPS_STATE": True}, "after a reset its results differ from those of a fresh instance"),
    ({"KEEPS_PARAMETERS": True}, "after a reset its results differ from those of a fresh instance"),
    ({"REPORTS_OLD_GAIN": True}, "after a reset its parameters differ from those of a fresh instance"),
    ({"RESET": 3}, "after a simulation fmi2Reset returned status 3"),
    (
        {"ANSWERS": 3, "AT": 0.5},
        "its reset cannot be tested with its declared start values: fmi2DoStep returned status 3",
    ),
)


@pytest.fixture
def calls(tmp_path, monkeypatch):
    """Return a reader of the letters of all calls since its last call."""
    log = tmp_path / "calls"
    monkeypatch.setenv("FOREIGN_LOG", str(log))

    def read():
        text = log.read_text() if log.exists() else ""
        log.write_text("")
        return text

    return read


@pytest.mark.parametrize("tolerance", [None, 1e-7])
def test_the_tolerance_is_that_of_the_default_experiment(tmp_path, tolerance):
    result = fly(odd_system(tmp_path, tolerance=tolerance))
    truth = fmpy.simulate_fmu(str(tmp_path / "odd.fmu"), stop_time=1.0, output_interval=0.25, output=["tolerance"])
    np.testing.assert_array_equal(result["odd.tolerance"], truth["tolerance"])
    assert set(result["odd.tolerance"]) == {-1.0 if tolerance is None else tolerance}


def test_a_flight_is_terminated_before_the_next_and_at_the_end(tmp_path, calls):
    path = odd_system(tmp_path)
    assert reset_verdict(load_fmu((tmp_path / "odd.fmu").read_bytes(), "odd")).resets
    calls()
    with Simulation(prepare_system(path)) as simulation:
        for _ in range(3):
            simulation.fly()
    assert calls() == "iex" + "trex" * 2 + "tf"


def test_a_flight_that_goes_on_is_not_terminated_in_between(tmp_path, calls):
    with Simulation(prepare_system(odd_system(tmp_path))) as simulation:
        simulation.advance(-1, 2)
        assert simulation.advance(2, 4)["odd.y"].tolist() == [2.25, 3.0]
        assert calls() == "iex"
    assert calls() == "tf"


def test_nothing_is_terminated_that_has_not_begun(tmp_path, calls):
    with Simulation(prepare_system(odd_system(tmp_path))):
        pass
    assert calls() == "if"


@pytest.mark.parametrize(("answer", "letters"), [(2, "iextf"), (3, "iexf"), (4, "iexif"), (42, "iexif"), (-1, "iexif")])
def test_what_may_be_called_after_a_failure(tmp_path, calls, answer, letters):
    """A discarded step can be terminated, an error only freed; after a fatal one, a fresh instance is at hand."""
    result = fly(odd_system(tmp_path, ANSWERS=answer, AT=0.5))
    assert (result.status, result.time.tolist()) == ("failed", [0.0, 0.25, 0.5])
    known = answer in (2, 3, 4)
    token = {2: "discard without asking for termination", 3: "error", 4: "fatal"}.get(
        answer, f"{answer}, which FMI does not define"
    )
    assert f"odd: fmi2DoStep returned {token}" in result.message
    assert known or "which FMI does not define" in result.message
    assert calls() == letters


@pytest.mark.parametrize("quirks", GOOD, ids=str)
def test_an_fmu_that_resets(tmp_path, quirks):
    fmu = load_fmu(odd_fmu(tmp_path, **quirks).read_bytes(), "odd.fmu")
    assert reset_verdict(fmu) == ResetVerdict(Renewal.RESET)


@pytest.mark.parametrize(("quirks", "reason"), BAD, ids=str)
def test_an_fmu_that_does_not_reset(tmp_path, calls, quirks, reason):
    path = odd_system(tmp_path, **quirks)
    fmu = load_fmu((tmp_path / "odd.fmu").read_bytes(), "odd.fmu")
    assert reset_verdict(fmu) == ResetVerdict(Renewal.INSTANCE, reason)
    assert calls()
    assert reset_verdict(load_fmu((tmp_path / "odd.fmu").read_bytes(), "again")) == ResetVerdict(
        Renewal.INSTANCE, reason
    )
    assert calls() == ""  # tried once
    notes = perilune.validate(path)[0].notes
    assert f"odd: instantiated again for every simulation, since its reset fails: {reason}" in notes
    assert any(note.endswith(reason) for note in perilune.validate(tmp_path / "odd.fmu")[0].notes)


@pytest.mark.parametrize("quirks", [{}, {"KEEPS_STATE": True}, {"KEEPS_PARAMETERS": True}, {"RESET": 3}], ids=str)
def test_no_flight_knows_of_the_one_before(tmp_path, quirks):
    with Simulation(prepare_system(odd_system(tmp_path, **quirks)), varied=["odd.gain"]) as simulation:
        for gain in (2.0, 5.0, 5.0, -1.0, 2.0):
            assert simulation.fly({"odd.gain": gain})["odd.y"][-1] == gain * 0.5 + 2.0


def test_an_instance_that_failed_does_not_fly_again(tmp_path):
    path = odd_system(tmp_path, BREAKS=True)
    with Simulation(prepare_system(path), varied=["odd.gain"]) as simulation:
        for gain in (2.0, -1.0, 2.0, -1.0, -1.0, 3.0):
            result = simulation.fly({"odd.gain": gain})
            assert result.status == ("failed" if gain < 0 else "stop_time")
            assert gain < 0 or result["odd.y"][-1] == gain * 0.5 + 2.0


def test_an_instance_that_asked_for_the_end_does_not_fly_again(tmp_path):
    """Stair of the Reference FMUs, after its reset, ends every flight with its first step: behind the trial's."""
    path = odd_system(tmp_path, stop=4.0, ENDS_AT=3.1, KEEPS_END=True)
    assert reset_verdict(load_fmu((tmp_path / "odd.fmu").read_bytes(), "odd.fmu")).resets
    with Simulation(prepare_system(path)) as simulation:
        for _ in range(3):
            result = simulation.fly()
            assert (result.status, result.time[-1]) == ("terminated", 3.1)
            np.testing.assert_allclose(result["odd.y"][-1], 9.3, rtol=1e-14)


def test_a_second_component_of_an_fmu_that_allows_one_instance_is_refused(tmp_path):
    odd_fmu(tmp_path, once=True)
    root = system(component("one", "odd"), component("two", "odd"))
    path = pack(tmp_path / "s.ssp", tmp_path, document(root))
    with pytest.raises(
        InputError, match=r"one, two: .*odd\.fmu can be instantiated only once in a process .*; remove one"
    ):
        fly(path)
    odd_fmu(tmp_path)
    assert fly(pack(tmp_path / "s.ssp", tmp_path, document(root))).status == "stop_time"


@pytest.mark.parametrize("quirks", [{}, {"KEEPS_STATE": True}], ids=str)
def test_one_instance_at_a_time(tmp_path, quirks):
    """The trial of its reset takes the place of the instance that flies."""
    prepared = prepare_system(odd_system(tmp_path, once=True, ONE_AT_A_TIME=True, **quirks))
    with Simulation(prepared) as simulation:
        for _ in range(3):
            assert simulation.fly()["odd.y"][-1] == 3.0
        with pytest.raises(InputError, match="can be instantiated only once in a process"):
            Simulation(prepared)
    assert perilune.simulate(tmp_path / "odd.ssp")["odd.y"][-1] == 3.0
