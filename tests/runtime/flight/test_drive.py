"""Inputs of a system over time: root connectors, inputs of components, faults on them, nested systems, batches.

Truth: closed forms; the same simulation with a component that generates the signal; the same system with the set value.
"""

from __future__ import annotations

import numpy as np
import pytest

from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.options.fault import Fault
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.runtime.system.series import read_series
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, pack, system

RAMP = {"time": [0.0, 1.0], "u": [1.0, 3.0]}  # u = 1 + 2 t


def fly(path, given, faults=(), **options):
    prepared = prepare_system(path, SystemOptions(**options), series=None if given is None else read_series(given))
    with Simulation(prepared, faults=faults) as simulation:
        first = {name: values.copy() for name, values in simulation.fly().signals.items()}
        repeated = simulation.fly()  # the instances are reset: the same comes again
        for name, values in first.items():
            assert np.array_equal(values, repeated.signals[name])
        return repeated


def gains(tiny, tmp_path, name="gains.ssp"):
    """Write a root input through a connection to a gain and a delay, and a gain whose input nothing is connected to."""
    return pack(
        tmp_path / name,
        tiny,
        document(
            system(
                component("gain", "gain", "input u Real m; output y Real m; parameter factor Real"),
                component("delay", "delay", "input u Real m; output y Real m"),
                component("free", "gain", "input u Real m; output y Real m"),
                declared="input u Real km",
                connections=connection("u", "gain.u") + connection("u", "delay.u"),
            )
        ),
    )


def test_root_connectors_and_inputs_of_components(tiny, tmp_path):
    path = gains(tiny, tmp_path)
    flight = fly(path, RAMP | {"free.u": [0.0, -1.0]})
    t = flight.time
    assert np.array_equal(flight["u"], 1.0 + 2.0 * t)
    assert np.array_equal(flight["gain.u"], 1000.0 * flight["u"])  # km to m
    assert np.array_equal(flight["gain.y"], 3.0 * flight["gain.u"])  # a follower: at the same time
    assert np.array_equal(flight["delay.y"][1:], flight["delay.u"][:-1])  # of class S: of a step before
    assert np.array_equal(flight["free.y"], 3.0 * flight["free.u"])
    assert np.array_equal(flight["free.u"], -t)


def test_what_is_driven_need_not_be_set(tiny, tmp_path):
    path = gains(tiny, tmp_path)
    with pytest.raises(InputError, match="neither connected nor given a value"):
        fly(path, RAMP)
    flight = fly(path, RAMP, set={"free.u": "4"})
    assert set(flight["free.y"].tolist()) == {12.0}
    constant = fly(path, {"time": [0.0], "u": [2.0]}, open_inputs="start")
    given = fly(path, None, set={"u": "2"}, open_inputs="start")
    for name in ("gain.y", "delay.y", "free.y"):
        assert np.array_equal(constant[name], given[name])


def test_as_a_component_that_makes_the_signal(tiny, tmp_path):
    created = pack(
        tmp_path / "made.ssp",
        tiny,
        document(
            system(
                component("ramp", "ramp", "output y Real m"),
                component("gain", "gain", "input u Real m; output y Real m"),
                component("delay", "delay", "input u Real m; output y Real m"),
                connections=connection("ramp.y", "gain.u") + connection("ramp.y", "delay.u"),
            )
        ),
    )
    expected = fly(created, None)
    driven = fly(gains(tiny, tmp_path), {"time": RAMP["time"], "u": [0.001, 0.003]}, open_inputs="start")
    for name in ("gain.y", "delay.y"):
        np.testing.assert_allclose(driven[name], expected[name], rtol=1e-15)


def test_faults_on_driven_inputs(tiny, tmp_path):
    path = gains(tiny, tmp_path)
    given = {"time": [0.0, 1.0], "u": [0.0, 0.0], "free.u": [1.0, 3.0]}
    flight = fly(path, given, [Fault("free.u", "bias", 10.0, 0.5, 0.75), Fault("gain.u", "override", 7.0, 0.75)])
    expected = 1.0 + 2.0 * flight.time + np.where(flight.time == 0.5, 10.0, 0.0)
    assert np.array_equal(flight["free.u"], expected)
    assert np.array_equal(flight["free.y"], 3.0 * expected)
    assert np.array_equal(flight["gain.y"], np.where(flight.time >= 0.75, 21.0, 0.0))


def test_nested_and_whole(tiny, tmp_path):
    inner = system(
        component("whole", "whole", "input n Integer; input b Boolean; output m Integer; output c Boolean"),
        connections=connection("n", "whole.n"),
        declared="input n Integer",
        name="inner",
    )
    path = pack(tmp_path / "nested.ssp", tiny, document(system(inner)))
    given = {"time": [0.0, 0.4, 0.9], "inner.n": [1, 2, 3], "inner.whole.b": [False, True, False]}
    flight = fly(path, given)
    assert flight["inner.whole.m"].tolist() == [1, 1, 2, 2, 3]  # at 0, 0.25 ... 1: held from its sample on
    assert flight["inner.whole.c"].tolist() == [0, 0, 1, 1, 0]


@pytest.mark.parametrize(
    ("given", "options", "expected"),
    [
        ({"gain.u": [0.0]}, {}, "input: column gain.u: is connected to u, which would overwrite it; drive"),
        ({"gain.factor": [0.0]}, {"set": {"gain.factor": 1}}, "set: gain.factor: is driven by column gain.factor of"),
        ({"w": [0.0]}, {}, "input: column w: no such input; use one of free.factor, free.u, gain.factor, u"),
        ({"u": [0.0]}, {"set": {"u": 1}}, "set: u: is driven by column u of the inputs over time; leave out"),
        ({"free.u": [0.0]}, {"set": {"free.u": 1}}, "set: free.u: is driven by column free.u of the inputs"),
    ],
)
def test_what_cannot_be_driven(tiny_folder, tmp_path, given, options, expected):
    path = gains(tiny_folder / "native", tmp_path)
    with pytest.raises(InputError) as error:
        fly(path, {"time": [0.0], **given}, open_inputs="start", **options)
    assert str(error.value).startswith(expected)


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [("n", 1.5, "1.5 is not of type Integer"), ("n", 3e9, "not of type Integer"), ("b", 2, "2 is not a Boolean")],
)
def test_values_that_a_type_cannot_have(tiny_folder, name, value, expected):
    with pytest.raises(InputError, match=f"input: sample 1, column {name}: .*{expected}"):
        fly(tiny_folder / "native" / "whole.fmu", {"time": [0.0, 1.0], name: [0, value]})


def test_a_name_twice_and_the_nearest(tiny_folder):
    path = tiny_folder / "native" / "whole.fmu"
    with pytest.raises(InputError, match=r"column whole\.n: drives whole\.n, which column n also drives; leave"):
        fly(path, {"time": [0.0], "n": [1], "whole.n": [1]})
    with pytest.raises(InputError, match="column m: no such input; use one of b, n"):
        fly(path, {"time": [0.0], "m": [1]})


CAMPAIGN = """
system = "gain"
trials = 6
seed = 3

[draw."gain.factor"]
distribution = "uniform"
low = 1.0
high = 2.0

[metric.last]
expression = "gain.y"
reduction = "final"

[metric.most]
expression = "gain.u"
reduction = "max"

[success]
expression = "last > 0"
"""


def test_a_campaign_of_an_fmu_alone(tiny, tmp_path):
    (tmp_path / "c.toml").write_text(CAMPAIGN)
    series = read_series({"time": [0.0, 1.0], "u": [1.0, 3.0]})
    options = SystemOptions(step=0.25, stop_time=1.0)
    plan = read_plan(tiny / "gain.fmu", str(tmp_path / "c.toml"), options, series=series)
    for workers in (1, 2):
        result = run_batch(plan, workers=workers)
        trials = result.trials["default"]
        assert np.array_equal(trials.metrics["last"], plan.draws.columns["gain.factor"] * 2.5)  # of a step before
        assert trials.metrics["most"].tolist() == [3.0] * 6
        assert result.provenance["input"]["signals"] == ["gain.u"]


def test_a_draw_of_what_is_driven_is_refused(tiny_folder, tmp_path):
    (tmp_path / "c.toml").write_text(CAMPAIGN.replace("gain.factor", "gain.u"))
    series = read_series({"time": [0.0], "u": [1.0]})
    plan = read_plan(tiny_folder / "native" / "gain.fmu", str(tmp_path / "c.toml"), SystemOptions(), series=series)
    with pytest.raises(
        InputError, match=r"c\.toml: gain.u: is driven by column u .*; leave out the column or the draw"
    ):
        run_batch(plan, workers=1)
