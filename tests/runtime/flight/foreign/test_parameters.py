"""Parameters of foreign FMUs: set values take effect, or the simulation names values that do not.

Truth: the closed form of the odd FMU, y = t (gain u + count + mode + 10 on) with u = 0.5; FMPy's simulate_fmu.
"""

import warnings

import fmpy
import numpy as np
import pytest

from perilune.analysis.cli import main
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.builders import component, connection, document, fly, inline, pack, system
from tests.support.foreign.odd_fmu import odd_fmu, odd_system

GIVEN = {"odd.gain": 3.3, "odd.count": 4, "odd.mode": "hover", "odd.on": True, "odd.word": "three"}
RATE = 3.3 * 0.5 + 4 + 7 + 10


def closed_form(result, rate):
    np.testing.assert_allclose(result["odd.y"], rate * np.array([0.0, 0.25, 0.5, 0.75, 1.0]), rtol=1e-13)
    return True


def test_all_types_arrive(tmp_path):
    result = fly(odd_system(tmp_path), set=GIVEN)
    assert closed_form(result, RATE)
    assert set(result["odd.length"]) == {5.0}
    start = {name.removeprefix("odd."): value for name, value in GIVEN.items()} | {"mode": 7}
    truth = fmpy.simulate_fmu(
        str(tmp_path / "odd.fmu"), stop_time=1.0, output_interval=0.25, start_values=start, output=["y", "length"]
    )
    np.testing.assert_array_equal(result["odd.y"], truth["y"])
    assert result.provenance["parameters"] == GIVEN | {"odd.mode": 7}


def test_what_is_lost_before_initialisation_mode_is_set_again(tmp_path):
    assert closed_form(fly(odd_system(tmp_path, LOSES_EARLY=True), set=GIVEN), RATE)


def test_who_refuses_to_be_set_again_is_not_asked_to(tmp_path):
    path = odd_system(tmp_path, REFUSES_AGAIN=True)
    for _ in range(2):
        assert closed_form(fly(path, set=GIVEN), RATE)
    result = fly(odd_system(tmp_path, REFUSES_AGAIN=True, IGNORES_GAIN=True), set=GIVEN)
    assert "odd.gain: was set to 3.3, but has the value 2.0 in its FMU" in result.message


def test_single_precision_is_no_loss(tmp_path):
    rate = float(np.float32(3.3)) * 0.5 + 1 + 1
    assert rate != 3.3 * 0.5 + 1 + 1
    assert closed_form(fly(odd_system(tmp_path, FLOAT32=True), set={"odd.gain": 3.3}), rate)


@pytest.mark.parametrize(
    ("quirk", "name", "words"),
    [
        ("IGNORES_GAIN", "gain", "was set to 3.3, but has the value 2.0 in its FMU"),
        ("IGNORES_COUNT", "count", "was set to 4, but has the value 1 in its FMU"),
        ("IGNORES_COUNT", "on", "was set to True, but has the value False in its FMU"),
        ("IGNORES_COUNT", "mode", "was set to 7, but has the value 1 in its FMU"),
        ("IGNORES_WORD", "word", "was set to three, but has the value one in its FMU"),
    ],
)
def test_what_an_fmu_does_not_take_ends_the_run_by_name(tmp_path, capsys, quirk, name, words):
    path = odd_system(tmp_path, **{quirk: True})
    values = {f"odd.{name}": GIVEN[f"odd.{name}"]}
    result = fly(path, set=values)
    assert (result.status, result.time.size) == ("failed", 0)
    assert f"odd.{name}: {words}" in result.message
    assert fly(path).status == "stop_time"
    value = str(values[f"odd.{name}"])
    assert main(["run", str(path), "--set", f"odd.{name}={value.lower() if value == 'True' else value}"]) == 1
    assert f"odd.{name}: {words}" in capsys.readouterr().err


def test_calculated_values_and_connected_inputs_are_not_asked_for(tiny_folder, tmp_path):
    assert closed_form(fly(odd_system(tmp_path), set={"odd.twice": 7.0}), 2.0 * 0.5 + 1 + 1)
    odd_fmu(tmp_path, "odd")
    (tmp_path / "ramp.fmu").write_bytes((tiny_folder / "native" / "ramp.fmu").read_bytes())
    parts = component("ramp", "ramp", "output y Real m"), component("odd", "odd", "input u Real; output y Real")
    path = pack(tmp_path / "s.ssp", tmp_path, document(system(*parts, connections=connection("ramp.y", "odd.u"))))
    (tmp_path / "u.ssv").write_text(
        '<ssv:ParameterSet version="1.0" name="u" '
        'xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues">'
        '<ssv:Parameters><ssv:Parameter name="odd.u"><ssv:Real value="9"/></ssv:Parameter></ssv:Parameters>'
        "</ssv:ParameterSet>"
    )
    result = fly(path, parameters=(str(tmp_path / "u.ssv"),))
    assert result.status == "stop_time"
    assert result["odd.u"].tolist() == [1.0, 1.5, 2.0, 2.5, 3.0]


def test_parameters_of_the_system_are_read_back_too(tmp_path):
    parts = component("odd", "odd", "parameter gain Real; output y Real")
    root = system(
        parts, connections=connection("g", "odd.gain"), declared="parameter g Real", bindings=inline("g=Real:4")
    )
    for quirk in ("LOSES_EARLY", "IGNORES_GAIN"):
        odd_fmu(tmp_path, **{quirk: True})
        result = fly(pack(tmp_path / "s.ssp", tmp_path, document(root)))
        assert quirk == "LOSES_EARLY" or "odd.gain: was set to 4.0, but has the value 2.0 in its FMU" in result.message
        assert quirk == "IGNORES_GAIN" or closed_form(result, 4.0 * 0.5 + 2.0)


@pytest.mark.parametrize("status", [2, 3])
@pytest.mark.parametrize("quirk", ["UNREADABLE_GAIN", "UNREADABLE_WORD"])
def test_what_cannot_be_read_back_is_said_once(tmp_path, quirk, status):
    path = odd_system(tmp_path, **{quirk: status})
    name = quirk.split("_")[1].lower()
    with pytest.warns(
        UserWarning, match=f"odd.fmu: {name} cannot be read back, so it is not known whether odd accepts its"
    ) as actual:
        assert closed_form(fly(path, set=GIVEN), RATE)
    assert len(actual) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert closed_form(fly(path, set=GIVEN), RATE)


def test_the_others_are_read_back_beside_one_that_cannot_be(tmp_path):
    path = odd_system(tmp_path, UNREADABLE_GAIN=3, IGNORES_COUNT=True)
    with pytest.warns(UserWarning, match="gain cannot be read back"):
        result = fly(path, set=GIVEN)
    assert "odd.count: was set to 4" in result.message


def test_not_a_number_is_taken_as_it_is(tmp_path):
    with Simulation(prepare_system(odd_system(tmp_path)), varied=["odd.gain"]) as simulation:
        assert simulation.fly({"odd.gain": float("nan")}).status == "nonfinite"
        assert simulation.fly({"odd.gain": 3.0})["odd.y"][-1] == 3.0 * 0.5 + 2.0
        assert simulation.fly({"odd.gain": 0.0})["odd.y"][-1] == 2.0


def test_strings_vary_from_flight_to_flight(tmp_path):
    prepared = prepare_system(odd_system(tmp_path), SystemOptions(set={"odd.word": "a"}))
    with Simulation(prepared, varied=["odd.word"]) as simulation:
        for token in ("to be", "or not", "", "\N{GREEK SMALL LETTER ALPHA}"):
            assert set(simulation.fly({"odd.word": token})["odd.length"]) == {float(len(token.encode()))}
