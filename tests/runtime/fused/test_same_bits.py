"""Fused steps, compiled as one function: results and messages equal those of native FMUs, to the last bit.

Truth: the same system simulated instruction by instruction.
"""

import re
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

import perilune
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.builders import component, connection, document, pack, system
from tests.support.graphs.small_blocks import graphs
from tests.support.lengths import either


def flown(path, flavour, values, faults=(), requested=None, **options):
    """Return two flights of one simulation: signals as bytes, status and message; of a refusal its words."""
    prepared = prepare_system(path, SystemOptions(flavour=flavour, set=values, **options))
    with Simulation(prepared, requested=requested, faults=faults) as simulation:
        ends = []
        for _ in range(2):
            flight = simulation.fly()
            signals = {name: rows.tobytes() for name, rows in flight.signals.items()}
            ends.append((flight.time.tobytes(), signals, flight.status, flight.message))
        assert (simulation.fused_steps != 0) == (flavour == "fused")
    return ends


@settings(max_examples=either(10_000, 8), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(graph=graphs())
def test_random_graphs(tiny_folder, tmp_path_factory, graph):
    ssd, values, faults, requested, algorithm = graph
    path = pack(tmp_path_factory.getbasetemp() / "graph.ssp", tiny_folder / "native", ssd)
    native, fused = (flown(path, each, values, faults, requested, algorithm=algorithm) for each in ("native", "fused"))
    assert fused == native


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("name", either(system_names(), ["orbital_attitude"]))
def test_whole_systems(name):
    native, fused = (perilune.simulate(name, flavour=flavour) for flavour in ("native", "fused"))
    assert {each: rows.tobytes() for each, rows in fused.signals.items()} == {
        each: rows.tobytes() for each, rows in native.signals.items()
    }
    assert (fused.status, fused.message, fused.provenance) == (native.status, native.message, native.provenance)


def test_a_failing_line_of_a_block_is_named(tiny_folder, tmp_path):
    path = pack(
        tmp_path / "s.ssp", tiny_folder / "native", document(system(component("t", "trouble", "output y Real m")))
    )
    ((*_, status, message), _), (native, _) = (flown(path, each, {"t.kind": 1}) for each in ("fused", "native"))
    assert status == "failed"
    assert re.search(
        r'tiny_blocks\.py", line \d+: ZeroDivisionError: .* in the step from t = 0\.5 s over h = 0\.25 s', message
    )
    assert message == native[-1]


@pytest.mark.parametrize("offset", ["INF", "1e400"])
def test_a_transformation_to_infinity(tiny_folder, tmp_path, offset):
    ssd = document(
        system(
            component("ramp", "ramp", "output y Real m"),
            component("gain", "gain", "input u Real m; output y Real m"),
            connections=connection("ramp.y", "gain.u", f'<ssc:LinearTransformation factor="1" offset="{offset}"/>'),
        )
    )
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", ssd)
    native, fused = (flown(path, each, {}) for each in ("native", "fused"))
    assert fused == native


def test_foreign_fmus_are_called_beside(tiny_folder, tmp_path, monkeypatch):
    """The stranger is no FMU of ours, and in Python: it is called as ever."""
    monkeypatch.delitem(sys.modules, "stranger", raising=False)  # of an FMU that another test simulated with FMPy
    ssd = document(
        system(
            component("ramp", "ramp", "output y Real m"),
            component("stranger", "stranger", "input u Real; output y Real"),
            component("gain", "gain", "input u Real m; output y Real m"),
            connections=connection("ramp.y", "stranger.u", attributes='suppressUnitConversion="true"')
            + connection("stranger.y", "gain.u", attributes='suppressUnitConversion="true"'),
        )
    )
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", ssd)
    native, fused = (flown(path, each, {}, in_process=True) for each in ("native", "fused"))
    assert fused == native
    assert np.isfinite(np.frombuffer(fused[0][1]["gain.y"])).all()


@pytest.mark.usefixtures("fmus")
def test_a_campaign_begun_native_and_gone_on_fused(tmp_path):
    """The folder is that of a campaign simulated as a whole, file by file."""
    options = {"configuration": "analytic_guidance", "stop_time": 5.0, "trials": either(80, 20)}
    campaign = ("lunar_terminal_guidance", "noisy")
    for flavour in ("native", "fused"):
        perilune.batch(
            *campaign, output=tmp_path / flavour, flavour=None if flavour == "native" else flavour, **options
        )
    perilune.batch(*campaign, output=tmp_path / "both", **options | {"trials": options["trials"] // 2})
    perilune.batch(*campaign, output=tmp_path / "both", flavour="fused", resume=True, **options)
    native, fused, both = (contents(tmp_path / name) for name in ("native", "fused", "both"))
    assert fused == native
    assert {name: native[name] for name in native if name.startswith("trials")} == {
        name: both[name] for name in both if name.startswith("trials")
    }


def contents(folder):
    """Return every file of a folder by its path in it."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
