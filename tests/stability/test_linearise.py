"""Linear model and measurement of systems of FMUs, compared with the same systems as plain recurrences.

Truth: exact_periodic.py; python-control; times of operating points in simulations.
"""

import control
import numpy as np
import pytest

import perilune
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.stability.point.bench import Bench, OperatingPoint, StudyError
from perilune.analysis.stability.point.linearise import linearise
from perilune.analysis.stability.request.channels import channels_of
from perilune.analysis.stability.request.declaration import LoopDeclaration, PointDeclaration
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, pack, system
from tests.support.loops.exact_periodic import EVERY, HYPERPERIOD, STATES, STEP, description, exact_model, hyperperiod
from tests.support.loops.exact_systems import difference, ring, with_stability
from tests.support.loops.sampled_loops import delay, held, response_of

LOOPS = [
    LoopDeclaration("first", "first.y", ("there",), period=EVERY[0] * STEP),
    LoopDeclaration("second", "second.y", ("there",), period=EVERY[1] * STEP),
]
NOISY = {
    "noise": ("noisy_counter", "u", "y", "sigma=Real:0.3"),
    "control": ("difference", "u", "y", "proportional=Real:0.02; derivative=Real:0.2; sample_period=Real:0.75"),
    "late": ("late", "u", "y", "samples=Integer:3"),
    "plant": ("held_mass", "u", "position", "speed=Real:0.125"),
}


@pytest.fixture
def bench_of(tmp_path):
    """Return a bench of a description at a point, with loops."""
    opened = []

    def bench(ssd, fmus, point, loops):
        prepared = prepare_system(pack(tmp_path / "s.ssp", fmus, ssd), SystemOptions())
        channels = [channel for loop in loops for channel in channels_of(loop, prepared.network, prepared.step)]
        opened.append(Bench(prepared, point, channels))
        return opened[-1]

    yield bench
    for item in opened:
        item.close()


@pytest.mark.parametrize("flavour", ["native", "python"])
def test_the_lifted_model_of_a_periodic_system(bench_of, exact_folder, flavour):
    """Multipliers, and all that what is added does within four hyperperiods, which no choice of states changes."""
    bench = bench_of(description(), exact_folder / flavour, PointDeclaration("there", time=1.0), LOOPS)
    assert (bench.period, bench.time) == (HYPERPERIOD, pytest.approx(HYPERPERIOD * STEP))
    actual, exact = linearise(OperatingPoint(bench)), exact_model()
    assert [(port.first, port.count) for port in actual.model.ports] == [(0, 3), (3, 2)]
    assert [port.seconds for port in actual.model.ports] == pytest.approx([0.4, 0.6])
    assert actual.model.poles() == pytest.approx(exact.poles(), abs=1e-8)
    for model in (actual.model, actual.neighbour):
        assert model.du == pytest.approx(exact.du, abs=1e-9)
        assert model.dv == pytest.approx(exact.dv, abs=1e-9)
        for power in range(4):
            mine, its = (np.linalg.matrix_power(item.a, power) @ item.b for item in (model, exact))
            assert model.cu @ mine == pytest.approx(exact.cu @ its, abs=1e-9)
            assert model.cv @ mine == pytest.approx(exact.cv @ its, abs=1e-9)


def test_both_routes_of_a_periodic_system(exact_fmus, tmp_path):
    declared = '<Point name="there" time="1"/>' + "".join(
        f'<Loop name="{loop.name}" cut="{loop.cut}" points="there" period="{loop.period}"/>' for loop in LOOPS
    )
    report = perilune.stability(pack(tmp_path / "s.ssp", exact_fmus, with_stability(description(), declared)))
    exact = exact_model()
    for axis, (loop, port) in enumerate(zip(report.loops, exact.ports, strict=True)):
        frequency = loop.measured_response.curve.frequency
        truth = exact.response((port,), frequency)[:, 0, 0]
        assert loop.sample_period == pytest.approx(port.seconds)
        low = frequency < 0.5 * np.pi / port.seconds
        assert abs(loop.measured_response.curve.value / truth - 1.0)[low].max() < 1e-6
        assert loop.agreement.agrees
        assert loop.linearised.period == pytest.approx(HYPERPERIOD * STEP)
        assert loop.linearised.periodicity > 1e-5
        truth = exact.response((port,), loop.curve.frequency)[:, 0, 0]
        assert (abs(loop.curve.value - truth) < 1e-6 * abs(truth) + 1e-9).all()
        assert loop.poles_z == pytest.approx(exact.poles(), abs=1e-8)
        poles = np.linalg.eigvals(hyperperiod((axis,))[0][:, :STATES])
        assert loop.unstable_open == np.sum(abs(poles) > 1.0 + 1e-6) == 0
        assert loop.closed == (report.loops[1 - axis].name,)


def test_noise_is_the_same_in_every_flight(bench_of, exact_fmus, tmp_path):
    """Neither route sees it; nor are the counter's means, which move nothing, in the model."""
    loop = LoopDeclaration("l", "control.y", ("there",), period=0.75)
    bench = bench_of(ring(NOISY, 0.25, 60.0), exact_fmus, PointDeclaration("there", time=10.0), [loop])
    actual = linearise(OperatingPoint(bench))
    assert not any(name.startswith("noise.mean") or "generator" in name for name in actual.model.names)
    exact = difference(0.02, 0.2, 0.75) * held(control.tf(1.0, [1.0, 0.0, 0.0]), 0.75) * delay(1, 0.75)
    frequency = np.geomspace(1e-2, 1.0, 50) * np.pi / 0.75
    response = actual.model.response(actual.model.ports, frequency)[:, 0, 0]
    truth = response_of(exact)(frequency)
    assert abs(response - truth).max() < 1e-7 * abs(truth).max()
    path = pack(tmp_path / "noisy.ssp", exact_fmus, ring(NOISY, 0.25, 60.0))
    (report,) = perilune.stability(path, loops=["plant.position"], at=10.0).loops
    assert report.measured_response.half_amplitude_change < 1e-6


def test_known_cells_give_the_same_model_sooner(bench_of, exact_fmus):
    bench = bench_of(description(), exact_fmus, PointDeclaration("there", time=1.0), LOOPS)
    first = linearise(OperatingPoint(bench))
    second = linearise(OperatingPoint(bench), first.cells)
    assert (second.cells, second.model.names) == (first.cells, first.model.names)
    assert second.model.a.tobytes() == first.model.a.tobytes()
    assert first.states == len(OperatingPoint(bench).memory.cells) > len(first.cells)


def test_drift_is_what_the_memory_does_over_a_period(bench_of, exact_fmus):
    bench = bench_of(description(), exact_fmus, PointDeclaration("there", time=1.0), LOOPS)
    point = OperatingPoint(bench)
    drift = {name: (value, change, unit) for name, value, change, unit in linearise(point).drift}
    values = bench.fly(-1, bench.origin + bench.period)["first.y"]
    assert drift["plant.position[1]"][2] == "m"
    value, change, unit = drift["plant.u[1]"]
    assert (value, unit) == (values[bench.origin], "m/s2")
    assert value + change == pytest.approx(values[bench.origin + bench.period], rel=1e-14)


def test_the_point_is_at_a_common_sample_at_its_time_or_later(bench_of, exact_fmus):
    times = {0.0: 1.2, 1.2: 1.2, 1.3: 2.4, 2.4 + 1e-9: 2.4, 5.0: 6.0}
    for time, expected in times.items():
        bench = bench_of(description(), exact_fmus, PointDeclaration("there", time=time), LOOPS)
        assert bench.time == pytest.approx(expected, abs=1e-9)
    short = [LoopDeclaration("second", "second.y", ("there",), period=EVERY[1] * STEP)]
    assert bench_of(description(), exact_fmus, PointDeclaration("there", time=0.0), short).period == HYPERPERIOD


def test_the_point_where_a_signal_falls_to_a_value(bench_of, exact_fmus):
    """A mass from 1 m at -0.125 m/s with its control off: 0.5 m after 4 s."""
    parts = NOISY | {
        "noise": ("noisy_counter", "u", "y", ""),
        "control": ("difference", "u", "y", "proportional=Real:0; derivative=Real:0"),
        "plant": ("held_mass", "u", "position", "speed=Real:-0.125"),
    }
    loop = LoopDeclaration("l", "control.y", ("there",))
    ssd = ring(parts, 0.25, 10.0)
    bench = bench_of(ssd, exact_fmus, PointDeclaration("there", signal="plant.position", falls_to=0.5), [loop])
    assert bench.time == pytest.approx(4.0)
    with pytest.raises(InputError, match=r"plant\.position never falls to -3"):
        bench_of(ssd, exact_fmus, PointDeclaration("there", signal="plant.position", falls_to=-3.0), [loop])
    with pytest.raises(InputError, match=r"no signal plant\.place"):
        bench_of(ssd, exact_fmus, PointDeclaration("there", signal="plant.place", falls_to=0.5), [loop])


@pytest.mark.parametrize(
    ("loop", "words"),
    [
        (LoopDeclaration("l", "first.z", ("there",)), r"no connector first\.z"),
        (
            LoopDeclaration("l", "first.y", ("there",), period=0.3),
            r"period 0\.3 s is not a whole number of communication steps",
        ),
        (LoopDeclaration("l", "first.y", ("there",), returned="plant.position"), r"plant\.position has 2 components"),
        (LoopDeclaration("l", "first.y", ("there",), direction="plant.u"), r"plant\.u"),
        (LoopDeclaration("l", "plant.coupling", ("there",)), r"plant\.coupling"),
    ],
)
def test_a_cut_that_does_not_fit_is_refused(bench_of, exact_fmus, loop, words):
    with pytest.raises(InputError, match=words) as caught:
        bench_of(description(), exact_fmus, PointDeclaration("there", time=1.0), [loop])
    assert "\n" not in str(caught.value)
    assert "loop l" in str(caught.value)


def test_a_flight_that_ends_early_is_told(bench_of, exact_fmus):
    """An upright pendulum without control leaves the range of numbers."""
    parts = {
        "control": ("difference", "u", "y", "proportional=Real:0; derivative=Real:0"),
        "plant": ("held_pendulum", "u", "position", "rate=Real:8"),
    }
    bench = bench_of(
        ring(parts, 0.25, 60.0),
        exact_fmus,
        PointDeclaration("there", time=400.0),
        [LoopDeclaration("l", "control.y", ("there",))],
    )
    with pytest.raises(StudyError, match=r"the simulation for point there ended early \(nonfinite at t = [\d.]+ s\)"):
        OperatingPoint(bench)


def test_a_connection_that_is_read_a_step_late_is_remembered(bench_of, tiny_folder):
    """Two FMUs, but no two variables, wait for each other.

    Around the loop ya = 2 a, yb = b + 1, twice each, two delays, the late connection and a factor: L = -0.4/z^3.
    """
    ends = "; ".join(f"input {name} Real m" for name in "ab") + "; output ya Real m; output yb Real m"
    parts = [component(name, "cross", ends) for name in ("here", "there")]
    parts += [component(name, "delay", "input u Real m; output y Real m") for name in ("one", "two")]
    wires = connection("here.ya", "there.b") + connection("there.yb", "one.u") + connection("one.y", "there.a")
    wires += connection("there.ya", "here.b") + connection("here.yb", "two.u")
    wires += connection("two.y", "here.a", inner='<ssc:LinearTransformation factor="0.1"/>')
    ssd = document(system(*parts, connections=wires), stop=20.0, step=0.25)
    bench = bench_of(
        ssd, tiny_folder / "native", PointDeclaration("there", time=2.0), [LoopDeclaration("l", "one.y", ("there",))]
    )
    assert len(bench.prepared.schedule.late) == 1
    model = linearise(OperatingPoint(bench)).model
    assert any("exchanged" in name for name in model.names)
    assert model.poles() ** 3 == pytest.approx([0.4] * 3, abs=1e-9)
    frequency = np.geomspace(0.01, 1.0, 20) * np.pi / 0.25
    assert model.response(model.ports, frequency)[:, 0, 0] == pytest.approx(-0.4 * np.exp(-0.75j * frequency), abs=1e-9)
