"""Campaign with faults at drawn times: simulated, stored, and simulated again.

Truth: each row of a ramp and a gain, computed here; simulations with `perilune.Fault` from the table of draws, with
equal bits; the same campaign without faults.
"""

import json
import pickle

import numpy as np
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.flyer import Flyer
from perilune.analysis.campaigns.folder.stored import read_batch
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, fly, pack, system
from tests.support.lengths import either

HEAD = """
system = "s"
trials = 12
seed = 3
[draw.case]
distribution = "grid"
values = [1, 2, 3, 4]
[draw.t0]
distribution = "uniform"
low = 0.3
high = 3
[draw.size]
distribution = "normal"
mean = 0
sigma = 1
[draw."ramp.start"]
distribution = "uniform"
low = -1
high = 1
[derive]
t1 = "t0 + 1"
[metric.last]
expression = "gain.y"
reduction = "final"
[metric.mean]
expression = "delay.y"
reduction = "mean"
[success]
expression = "last > 0"
"""
ALL = '[record]\ntraces = "all"\n'
SHIFTED = '[fault.shifted]\nconnector = "gain.u"\nkind = "bias"\nvalue = "2 * size"\nstart = "t0"\nend = "t1"\n'
FAULTS = f"""
{SHIFTED}when = "case == 1"
[fault.held]
connector = "ramp.y"
kind = "freeze"
start = "t0"
when = "case == 2 or case == 3"
[fault.up]
connector = "whole.b"
kind = "override"
value = true
start = 1
end = "t1 + 1"
when = "case != 4"
"""
STEP, ROWS = 0.25, 21


@pytest.fixture(scope="module")
def ssp(tiny_folder, tmp_path_factory):
    """Write in either flavour a ramp, a gain and a delay after it, whole numbers of the ramp."""
    parts = (
        component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer"),
        component("gain", "gain", "input u Real m; output y Real m"),
        component("delay", "delay", "input u Real m; output y Real m"),
        component("whole", "whole", "input n Integer; input b Boolean; output m Integer; output c Boolean"),
    )
    wires = connection("ramp.y", "gain.u") + connection("ramp.y", "delay.u")
    wires += connection("ramp.flag", "whole.b") + connection("ramp.count", "whole.n")
    folder = tmp_path_factory.mktemp("faults")
    text = document(system(*parts, connections=wires), stop=STEP * (ROWS - 1), step=STEP)
    actual = {}
    for flavour in ("native", "python"):
        (folder / flavour).mkdir()
        actual[flavour] = pack(folder / flavour / "s.ssp", tiny_folder / flavour, text)
    return actual


def written(folder, text, name="c.toml"):
    (folder / name).write_text(HEAD + text)
    return str(folder / name)


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    return written(tmp_path_factory.mktemp("campaign"), ALL + FAULTS)


@pytest.fixture(scope="module")
def result(ssp, campaign, tmp_path_factory):
    folder = tmp_path_factory.mktemp("stored") / "out"
    return perilune.batch(ssp["native"], campaign, workers=1, output=folder), folder


def by_hand(row):
    """Return the faults of a trial from its draws, as a Python program would create them."""
    t0, end, faults = row["t0"], row["t0"] + 1.0, []
    if row["case"] == 1:
        faults.append(perilune.Fault("gain.u", "bias", 2.0 * row["size"], t0, end))
    if row["case"] in (2, 3):
        faults.append(perilune.Fault("ramp.y", "freeze", start=t0))
    if row["case"] != 4:
        faults.append(perilune.Fault("whole.b", "override", True, 1.0, end + 1.0))
    return faults


def computed(row):
    """Compute the readers' rows from the definition of the faults and of the blocks (slope 2 m/s, factor 3)."""
    time = STEP * np.arange(ROWS)
    y = row["ramp.start"] + 2.0 * time
    if row["case"] in (2, 3):
        y = np.where(time >= row["t0"], y[np.argmax(time >= row["t0"])], y)
    inside = (time >= row["t0"]) & (time < row["t0"] + 1.0)
    gain = 3.0 * (y + np.where(inside & (row["case"] == 1), 2.0 * row["size"], 0.0))
    up = (time >= 1.0) & (time < row["t0"] + 2.0) & (row["case"] != 4)
    return {"ramp.y": y, "gain.y": gain, "whole.c": up, "whole.m": np.arange(ROWS)}


def drawn(table, trial):
    row = table.slice(trial, 1).to_pylist()[0]
    return {name.removeprefix("draw."): value for name, value in row.items() if name.startswith("draw.")}


def test_every_trial_is_what_its_draws_say(result):
    batch, _ = result
    table = batch.table()
    for trial in range(12):
        row, traces = drawn(table, trial), batch.trials["default"].traces[trial]
        for name, expected in computed(row).items():
            np.testing.assert_allclose(traces[name], expected, rtol=1e-12, atol=1e-12, err_msg=f"{name}, trial {trial}")
        assert table["metric.last"][trial].as_py() == traces["gain.y"][-1]


def test_every_trial_is_the_flight_of_faults_made_by_hand(result, ssp):
    batch, _ = result
    for trial in range(12):
        row = drawn(batch.table(), trial)
        flight = fly(ssp["native"], by_hand(row), set={"ramp.start": row["ramp.start"]})
        traces = batch.trials["default"].traces[trial]
        assert {name: values.tobytes() for name, values in flight.signals.items()} == {
            name: values.tobytes() for name, values in traces.items() if name != "time"
        }


@pytest.mark.parametrize(("flavour", "workers"), either([("native", 3), ("python", 1)], [("native", 3)]))
def test_the_same_bits_whatever_flies_it(result, ssp, campaign, flavour, workers):
    batch, _ = result
    repeated = perilune.batch(ssp[flavour], campaign, workers=workers)
    assert repr(repeated.table().to_pydict()) == repr(batch.table().to_pydict())  # of every digit, and nan is nan


def test_the_same_bits_whatever_is_recorded(result, ssp, tmp_path):
    """Only what metrics need is fetched from the FMUs then, and outputs with faults, whether they are read or not."""
    batch, _ = result
    unread = '[fault.unread]\nconnector = "whole.m"\nkind = "bias"\nvalue = 1\nstart = "t0"\n'
    table = perilune.batch(ssp["native"], written(tmp_path, FAULTS + unread), workers=1).table()
    known = [name for name in table.column_names if "unread" not in name]
    assert repr(table.select(known).to_pydict()) == repr(batch.table().to_pydict())


def test_other_processes_are_sent_the_same_faults(ssp, campaign):
    plan = read_plan(ssp["python"], campaign, SystemOptions(), faults=[perilune.Fault("gain.u", "freeze")])
    sent = pickle.loads(pickle.dumps(plan))
    assert [sent.faults_of(trial) for trial in range(12)] == [plan.faults_of(trial) for trial in range(12)]


def test_a_replay_flies_them_again(result, ssp, campaign):
    batch, _ = result
    plan = read_plan(ssp["native"], campaign, SystemOptions())
    flyer = Flyer(plan)
    for trial in (8, 1, 3):
        flight, actual = flyer.replay("default", trial)
        traces = batch.trials["default"].traces[trial]
        assert {name: values.tobytes() for name, values in flight.signals.items()} == {
            name: values.tobytes() for name, values in traces.items() if name != "time"
        }
        assert actual.metrics["last"] == batch.table()["metric.last"][trial].as_py()
        assert flight.provenance["faults"] == [str(fault) for fault in by_hand(drawn(batch.table(), trial))]
    assert flight.provenance["faults"] == []


SAYS = [
    "shifted: gain.u=bias:2 * size@t0..t1 when case == 1",
    "held: ramp.y=freeze@t0 when case == 2 or case == 3",
    "up: whole.b=override:true@1..t1 + 1 when case != 4",
]


def test_what_is_stored(result):
    batch, folder = result
    assert json.loads((folder / "summary.json").read_text())["faults"] == SAYS
    assert read_batch(folder).faults == SAYS
    assert batch.text().splitlines()[-1] == f"with faults: {'; '.join(SAYS)}"
    rows = pyarrow.parquet.read_table(folder / "trials").to_pylist()
    names = [f"fault.shifted{key}" for key in ("", ".value", ".start", ".end")]
    names += [f"fault.held{key}" for key in ("", ".start", ".end")]
    names += [f"fault.up{key}" for key in ("", ".value", ".start", ".end")]
    assert [name for name in rows[0] if name.startswith("fault.")] == names
    for row in rows:
        assert [row["fault.shifted"], row["fault.held"], row["fault.up"]] == [
            row["draw.case"] == 1, row["draw.case"] in (2, 3), row["draw.case"] != 4,
        ]  # fmt: skip
        if row["fault.shifted"]:
            assert row["fault.shifted.value"] == 2 * row["draw.size"]
            assert (row["fault.shifted.start"], row["fault.shifted.end"]) == (row["draw.t0"], row["draw.t1"])


def test_the_users_faults_fly_in_every_trial_after_the_campaigns(ssp, tmp_path):
    """Another override of the connector wins; in all variants."""
    own = perilune.Fault("gain.u", "override", 4.0, 2.0, 3.0)
    path = written(tmp_path, ALL + SHIFTED)
    batch = perilune.batch(ssp["native"], path, workers=1, faults=[own], output=tmp_path / "out")
    for trial in range(12):
        row, traces = drawn(batch.table(), trial), batch.trials["default"].traces[trial]
        time = traces["time"]
        plain = computed(row | {"case": 1})["gain.y"]
        np.testing.assert_allclose(traces["gain.y"], np.where((time >= 2) & (time < 3), 12.0, plain), atol=1e-12)
    assert read_batch(tmp_path / "out").faults == ["shifted: gain.u=bias:2 * size@t0..t1", "gain.u=override:4@2..3"]
    assert [name for name in batch.table().column_names if "fault" in name] == [
        f"fault.shifted{key}" for key in ("", ".value", ".start", ".end")
    ]


def test_nothing_says_faults_where_there_are_none(ssp, tmp_path):
    """And faults that fly in no trial change no bit of the flights."""
    bare = perilune.batch(ssp["native"], written(tmp_path, ALL), workers=1, output=tmp_path / "bare")
    never = written(tmp_path, ALL + SHIFTED + 'when = "case > 9"\n', "never.toml")
    with_none = perilune.batch(ssp["native"], never, workers=1)
    assert "faults" not in json.loads((tmp_path / "bare" / "summary.json").read_text())
    assert "with faults" not in bare.text()
    own = [name for name in with_none.table().column_names if not name.startswith("fault.")]
    assert bare.table().column_names == own
    assert repr(with_none.table().select(own).to_pydict()) == repr(bare.table().to_pydict())


@pytest.mark.parametrize(
    ("text", "own", "says"),
    [
        (SHIFTED.replace("gain.u", "gain.w"), [], "c.toml: fault.shifted.connector: no component has such a connector; "
         "the nearest of 15 known names: gain.u, gain.y"),
        (SHIFTED.replace("gain.u", "ramp.count"), [], "c.toml: fault.shifted.value: "),
        (SHIFTED.replace("gain.u", "whole.c"), [], "c.toml: fault.shifted.value: a Boolean has no bias"),
        (SHIFTED.replace('"2 * size"', "true"), [], "c.toml: fault.shifted.value: true is not of type Real"),
        (SHIFTED.replace('"t1"', '"t0"'), [], "c.toml: fault.shifted.end: "),
        (SHIFTED, [perilune.Fault("gain.w", "bias", 1.0)], "fault: gain.w: no component has such a connector"),
        ("", [perilune.Fault("whole.b", "override", 3.0)], "fault: whole.b: 3 is not a Boolean"),
    ],
)  # fmt: skip
def test_refused_before_anything_is_written(ssp, tmp_path, text, own, says):
    path = written(tmp_path, text)
    with pytest.raises(InputError) as caught:
        perilune.batch(ssp["native"], path, workers=1, faults=own, output=tmp_path / "out")
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "out").exists()
