"""Recorded variables that are not exchanged: local variables and parameters.

Truth: FMPy, which also records them after each step; closed forms; the same simulation without recording.
"""

import csv
import re

import numpy as np
import pytest
from fmpy import simulate_fmu

from perilune import open_results
from perilune.analysis.cli import main
from perilune.analysis.runtime.flight.selection import find_variables
from perilune.analysis.runtime.process.opening import open_simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, pack, retouched, system
from tests.support.foreign.lag import DESCRIPTION, lag_fmu

RAMP = component("ramp", "ramp", "output y Real m")
GAIN = component("gain", "gain", "input u Real m; output y Real m")


def local(text):
    """Return a description whose outputs are local variables."""
    text = re.sub(r"<ModelStructure>.*</ModelStructure>", "<ModelStructure/>", text, flags=re.S)
    return text.replace('causality="output"', 'causality="local"')


@pytest.fixture
def lag(tmp_path):
    """Build y' = (u - y) / 0.5, foreign."""
    assert 'name="y"' in DESCRIPTION
    return lag_fmu(tmp_path, 0.5)


@pytest.fixture
def without_outputs(lag, tmp_path):
    retouched(lag, tmp_path / "lag_local.fmu", local)
    return tmp_path / "lag_local.fmu"


def recorded(path, names, **options):
    prepared = prepare_system(path, SystemOptions(**options))
    more = find_variables(prepared.network, names, is_alone=prepared.archive.is_fmu)
    with open_simulation(prepared, additional=more) as simulation:
        result = simulation.fly()
    return {name: values.copy() for name, values in result.signals.items()}


def test_a_local_variable_has_the_values_of_fmpy(without_outputs):
    result = recorded(without_outputs, ["y"], set={"lag.u": "2"}, step=0.125, stop_time=1.0)
    truth = simulate_fmu(
        str(without_outputs),
        start_values={"u": 2.0},
        output=["y"],
        stop_time=1.0,
        step_size=0.125,
        output_interval=0.125,
    )
    np.testing.assert_array_equal(result["lag.y"], truth["y"])
    np.testing.assert_allclose(result["lag.y"][-1], 2.0 * (1.0 - np.exp(-2.0)), rtol=0.2)


def test_the_command_line(without_outputs, tmp_path, capsys):
    words = ["run", str(without_outputs), "--step", "0.125", "--stop-time", "1"]
    assert main(words) == 0
    assert "no FMU has an output; name variables to record with --record" in " ".join(capsys.readouterr().out.split())
    file, page = tmp_path / "o.csv", tmp_path / "o.html"
    assert main([*words, "--record", "y", "--output", str(file), "--report", str(page)]) == 0
    rows = list(csv.reader(file.open()))
    assert rows[0] == ["time", "lag.y"]
    assert len(rows) == 10
    assert "lag.y" in page.read_text()


@pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])
def test_the_flight_is_the_same(tiny, tmp_path, algorithm):
    """Parameters are what they were set to; what is exchanged has the same bits."""
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, connections=connection("ramp.y", "gain.u"))))
    plain = recorded(path, [], algorithm=algorithm)
    more = recorded(path, ["ramp.slope", "ramp.inverted", "ramp.flag_at", "gain.y"], algorithm=algorithm)
    for name, values in plain.items():
        np.testing.assert_array_equal(more[name], values)
    assert set(more) - set(plain) == {"ramp.slope", "ramp.inverted", "ramp.flag_at"}
    assert (more["ramp.slope"] == 2.0).all()
    assert (more["ramp.flag_at"] == 1000000).all()
    assert not more["ramp.inverted"].any()


@pytest.mark.parametrize(
    ("name", "words"),
    [("ramp.slop", r"record: ramp\.slop: no such variable; .*ramp\.slope"), ("ramp", "no such variable")],
)
def test_what_is_refused(tiny, tmp_path, name, words):
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP)))
    with pytest.raises(InputError, match=words):
        recorded(path, [name])


CAMPAIGN = """
system = "{}"
trials = 3
seed = 1
[draw."lag.u"]
distribution = "choice"
values = [1, 2, 3]
[record]
final = ["lag.y"]
signals = ["lag.y"]
every = 5
[metric.end]
expression = "lag.y / lag.u"
reduction = "final"
[success]
expression = "end > 0"
"""


def test_campaigns_name_any_variable(without_outputs, tmp_path):
    """The lag is linear: the ratio of its last value to its input is that of a single flight."""
    campaign = tmp_path / "c.toml"
    campaign.write_text(CAMPAIGN.format(without_outputs.stem))
    out = tmp_path / "out"
    words = ["--campaign", str(campaign), "--output", str(out), "--step", "0.125", "--stop-time", "1"]
    assert main(["batch", str(without_outputs), *words]) == 0
    truth = recorded(without_outputs, ["y"], set={"lag.u": "1"}, step=0.125, stop_time=1.0)["lag.y"][-1]
    frame = open_results(out).dataset.to_table().to_pydict()
    np.testing.assert_allclose(frame["metric.end"], truth, rtol=1e-15)
    np.testing.assert_allclose(np.array(frame["final.lag.y"]) / np.array(frame["draw.lag.u"]), truth, rtol=1e-15)
