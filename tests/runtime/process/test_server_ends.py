"""Simulation server that is killed, as by an operating system without free memory: no FMU is blamed.

Truth: the integral of the FMU's source, y(1 s) = gain u + count + mode; the check of an FMU that resets.
"""

from __future__ import annotations

import pytest

from perilune.analysis.runtime.instances.renewal import verdict_in_cache
from perilune.analysis.runtime.process import children, resets, system_process
from perilune.analysis.runtime.process.children import start_server
from perilune.analysis.runtime.process.opening import open_simulation
from perilune.analysis.runtime.process.resets import find_verdict
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import EndedError
from tests.support.foreign.odd_fmu import Call, Deed, odd_fmu

pytestmark = [pytest.mark.flies, pytest.mark.skipif(not children.CAN_FORK, reason="there is no flight server")]
OPTIONS = SystemOptions(stop_time=1.0, step=0.25)


def kill_server():
    server = start_server()._process
    server.kill()
    server.wait()


@pytest.fixture
def opened(tmp_path):
    with open_simulation(prepare_system(odd_fmu(tmp_path), OPTIONS), varied=["odd.gain"]) as opened:
        yield opened


def flight(opened, gain):
    flown = opened.run({"odd.gain": gain})
    return flown.status, flown.message, flown["odd.y"][-1:].tolist()


@pytest.mark.parametrize("count", [0, 1, 2])
def test_what_was_under_way_is_simulated_on_another_server(opened, count):
    """Before, in and behind the flight with which a verdict on the FMU's reset is looked for."""
    gains = [1.0, 3.0, 5.0, 7.0]
    for gain in gains[:count]:
        opened.run({"odd.gain": gain})
    opened.queue_run({"odd.gain": gains[count]}, ())
    kill_server()
    assert [flight(opened, gain) for gain in gains[count:]] == [
        ("stop_time", "", [0.5 * gain + 2.0]) for gain in gains[count:]
    ]
    (fmu,) = opened.prepared.network.fmus.values()
    assert find_verdict(fmu, OPTIONS).resets


def test_servers_that_end_again_and_again_are_reported_without_a_component(opened, monkeypatch):
    begin = system_process.begin_child

    def begin_and_kill(*arguments, **options):
        child = begin(*arguments, **options)
        kill_server()
        return child

    monkeypatch.setattr(system_process, "begin_child", begin_and_kill)
    kill_server()
    assert flight(opened, 1.0) == ("crashed", "the flight server has ended", [])
    monkeypatch.undo()
    assert flight(opened, 1.0) == ("stop_time", "", [2.5])


def test_nothing_is_stored_of_an_fmu_whose_trial_ends_with_the_server(tmp_path, monkeypatch):
    """Its steps do not end, so that the trial cannot be over before the server is."""
    begin = resets.begin_child

    def begin_and_kill(*arguments, **options):
        child = begin(*arguments, **options)
        kill_server()
        return child

    hanging = odd_fmu(tmp_path, DEED=Deed.HANG, IN=Call.STEP)
    (fmu,) = prepare_system(hanging, OPTIONS).network.fmus.values()
    monkeypatch.setattr(resets, "begin_child", begin_and_kill)
    with pytest.raises(EndedError, match="the flight server has ended; simulate again"):
        find_verdict(fmu, OPTIONS)
    assert verdict_in_cache(fmu) is None


def test_a_flight_that_goes_on_from_a_point_is_lost_with_its_server(opened):
    assert opened.advance(-1, 2).complete
    kill_server()
    lost = opened.advance(2, 4)
    assert (lost.status, lost.message) == ("crashed", "the flight server has ended")
    assert opened.run({"odd.gain": 1.0}).complete


def test_what_happens_when_it_is_freed_is_not_noted(tmp_path, recwarn):
    with open_simulation(prepare_system(odd_fmu(tmp_path), OPTIONS)) as opened:
        opened.run({})
        kill_server()
    assert not recwarn.list
