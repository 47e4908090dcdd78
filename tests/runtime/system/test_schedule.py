"""Order of execution of tiny FMUs, in both flavours, with every row computed by hand.

Truth: results by hand. A ramp counts 1, 1.5, 2, ...; a gain triples at the same time; a delay returns its input of one
step before. In the sequential algorithm followers respond at the same time; in the Jacobi algorithm all FMUs use the
last exchange.
"""

import itertools

import pytest

from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.common.paths import FLAVOURS
from tests.support.builders import component, connection, document, fly, pack, system

RAMP = component("ramp", "ramp", "output y Real m")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
DELAY = component("delay", "delay", "input u Real m; output y Real m")
RAMP_GAIN_DELAY = connection("ramp.y", "gain.u") + connection("gain.y", "delay.u")


@pytest.fixture(params=FLAVOURS)
def tiny(request, tiny_folder):
    return tiny_folder / request.param


@pytest.mark.parametrize("order", [(RAMP, GAIN, DELAY), (DELAY, GAIN, RAMP), (GAIN, DELAY, RAMP)])
def test_chain_sequential(tiny, tmp_path, order):
    path = pack(tmp_path / "s.ssp", tiny, document(system(*order, connections=RAMP_GAIN_DELAY)))
    result = fly(path)
    assert result.time.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert result["ramp.y"].tolist() == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert result["gain.u"].tolist() == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert result["gain.y"].tolist() == [3.0, 4.5, 6.0, 7.5, 9.0]
    assert result["delay.u"].tolist() == [3.0, 4.5, 6.0, 7.5, 9.0]
    assert result["delay.y"].tolist() == [5.0, 3.0, 4.5, 6.0, 7.5]


@pytest.mark.parametrize("order", [(RAMP, GAIN, DELAY), (DELAY, GAIN, RAMP)])
def test_chain_jacobi(tiny, tmp_path, order):
    path = pack(tmp_path / "s.ssp", tiny, document(system(*order, connections=RAMP_GAIN_DELAY)))
    result = fly(path, algorithm="jacobi")
    assert result["ramp.y"].tolist() == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert result["gain.y"].tolist() == [3.0, 3.0, 4.5, 6.0, 7.5]
    assert result["gain.u"].tolist() == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert result["delay.y"].tolist() == [5.0, 3.0, 3.0, 4.5, 6.0]


def test_closed_loop(tiny, tmp_path):
    wires = connection("delay.y", "gain.u") + connection("gain.y", "delay.u")
    path = pack(tmp_path / "s.ssp", tiny, document(system(GAIN, DELAY, connections=wires)))
    sequential = fly(path)
    assert sequential["delay.y"].tolist() == [5.0, 15.0, 45.0, 135.0, 405.0]
    assert sequential["gain.y"].tolist() == [15.0, 45.0, 135.0, 405.0, 1215.0]
    jacobi = fly(path, algorithm="jacobi")
    assert jacobi["delay.y"].tolist() == [5.0, 15.0, 15.0, 45.0, 45.0]
    assert jacobi["gain.y"].tolist() == [15.0, 15.0, 45.0, 45.0, 135.0]


def test_sources_in_a_row_read_each_other_one_step_late(tiny, tmp_path):
    second = component("second", "delay", "input u Real m; output y Real m")
    wires = connection("delay.y", "second.u") + connection("ramp.y", "delay.u")
    for order in ((RAMP, DELAY, second), (second, DELAY, RAMP)):
        result = fly(pack(tmp_path / "s.ssp", tiny, document(system(*order, connections=wires))))
        assert result["delay.y"].tolist() == [5.0, 1.0, 1.5, 2.0, 2.5]
        assert result["second.y"].tolist() == [5.0, 5.0, 1.0, 1.5, 2.0]


@pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])
def test_sources_are_initialised_on_declared_starts_not_on_zeros(tiny, tmp_path, algorithm):
    careful = component("careful", "careful", "input u Real m; output y Real m")
    wires = connection("careful.y", "gain.u") + connection("gain.y", "careful.u")
    result = fly(
        pack(tmp_path / "s.ssp", tiny, document(system(careful, GAIN, connections=wires))), algorithm=algorithm
    )
    assert result.status == "stop_time", result.message
    assert result["careful.y"].tolist()[:2] == [4.0, 12.0]
    assert result["careful.u"].tolist()[0] == 12.0


CROSS = "input a Real m; input b Real m; output ya Real m; output yb Real m"


def test_a_cycle_between_fmus_only_runs_and_is_told(tiny, tmp_path):
    """left.ya -> right.a -> right.ya -> left.b -> left.yb: no variable waits for itself, the FMUs do."""
    left, right = component("left", "cross", CROSS), component("right", "cross", CROSS)
    wires = (
        connection("ramp.y", "left.a")
        + connection("left.ya", "right.a")
        + connection("right.ya", "left.b")
        + connection("left.yb", "right.b")
    )
    for order in ((RAMP, left, right), (right, left, RAMP)):
        path = pack(tmp_path / "s.ssp", tiny, document(system(*order, connections=wires)))
        prepared = prepare_system(path)
        assert prepared.schedule.late == ["right.ya -> left.b"]  # one is enough
        result = fly(path)
        ramp = [1.0, 1.5, 2.0, 2.5, 3.0]
        # in row 0 everything has settled: left.yb = 2 * 2 * ramp + 1
        assert result["right.ya"][0] == 4.0
        assert result["left.yb"][0] == 5.0
        assert result["right.yb"][0] == 6.0
        assert result["left.ya"].tolist() == [2 * y for y in ramp]
        assert result["right.ya"].tolist() == [4 * y for y in ramp]
        assert result["left.yb"].tolist() == [5.0, *(4 * y + 1 for y in ramp[:-1])]
        assert result["right.yb"].tolist() == [6.0, *(4 * y + 2 for y in ramp[:-1])]


def test_a_cycle_of_three_fmus_runs_too(tiny, tmp_path):
    """a.ya -> b.a, b.ya -> c.a, c.ya -> a.b: round the three FMUs without a loop of variables."""
    elements = [component(name, "cross", CROSS) for name in "abc"]
    wires = connection("ramp.y", "a.a") + connection("a.ya", "b.a") + connection("b.ya", "c.a")
    wires += connection("c.ya", "a.b") + connection("ramp.y", "b.b") + connection("ramp.y", "c.b")
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, *elements, connections=wires)))
    assert prepare_system(path).schedule.late == ["c.ya -> a.b"]
    result = fly(path)
    ramp = [1.0, 1.5, 2.0, 2.5, 3.0]
    assert result["c.ya"].tolist() == [8 * y for y in ramp]
    assert result["a.yb"].tolist() == [9.0, *(8 * y + 1 for y in ramp[:-1])]


def test_an_algebraic_loop_is_refused_with_its_cycle(tiny, tmp_path):
    wires = connection("gain.y", "second.u") + connection("second.y", "gain.u")
    second = component("second", "gain", "input u Real m; output y Real m")
    path = pack(tmp_path / "s.ssp", tiny, document(system(GAIN, second, connections=wires)))
    with pytest.raises(InputError) as caught:
        prepare_system(path)
    cycle = caught.value.problem.split(" -> ")
    assert cycle[0] == cycle[-1]
    assert set(cycle) == {"gain.u", "gain.y", "second.u", "second.y"}
    following = {"gain.u": "gain.y", "gain.y": "second.u", "second.u": "second.y", "second.y": "gain.u"}
    assert all(following[here] == there for here, there in itertools.pairwise(cycle))
    third = component("third", "gain", "input u Real m; output y Real m")
    wires = connection("gain.y", "second.u") + connection("second.y", "third.u") + connection("third.y", "gain.u")
    longer = pack(tmp_path / "t.ssp", tiny, document(system(GAIN, second, third, connections=wires)))
    with pytest.raises(
        InputError, match=r"gain\.u -> gain\.y -> second\.u -> second\.y -> third\.u|second\.y -> third\.u"
    ):
        prepare_system(longer)
    # with an option that one of them does not answer at once, it runs
    result = fly(path, no_feedthrough=("second",), set={"gain.factor": 2.0})
    assert result["gain.y"].tolist()[0] == 0.0


def test_an_algebraic_loop_through_system_connectors_is_seen(tiny, tmp_path):
    inner = system(
        component("gain", "gain", "input u Real m; output y Real m"),
        declared="input in Real m; output out Real m",
        connections=connection("in", "gain.u") + connection("gain.y", "out"),
        name="inner",
    )
    path = pack(tmp_path / "s.ssp", tiny, document(system(inner, connections=connection("inner.out", "inner.in"))))
    with pytest.raises(InputError, match=r"algebraic loop.*inner\.gain\.u"):
        prepare_system(path)


def test_an_undeclared_output_is_one_on_all_inputs_only_if_the_user_says_so(tiny, tmp_path):
    odd = component("odd", "stranger", "input u Real; output y Real; output length Real")
    path = pack(tmp_path / "s.ssp", tiny, document(system(odd, connections=connection("odd.length", "odd.u"))))
    with pytest.raises(InputError, match="algebraic loop"):
        prepare_system(path, SystemOptions(feedthrough=("odd",)))
    for options in (SystemOptions(), SystemOptions(no_feedthrough=("odd",))):
        assert prepare_system(path, options).schedule.sources_first == ["odd"]
    with pytest.raises(InputError, match=r"no_feedthrough: nobody: no such component; use one of odd"):
        prepare_system(path, SystemOptions(no_feedthrough=("nobody",)))


def test_step_and_stop_times(tiny, tmp_path):
    parts = system(RAMP)
    path = pack(tmp_path / "s.ssp", tiny, document(parts))
    assert fly(path).time.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert fly(path, step=0.5).time.tolist() == [0.0, 0.5, 1.0]
    assert fly(path, step=0.1, stop_time=0.3).time.tolist() == [0.0, 0.1, 0.2, 0.30000000000000004]
    path = pack(tmp_path / "t.ssp", tiny, document(parts, step=None))
    assert prepare_system(path).step == 0.1  # the FMU's proposal
    path = pack(tmp_path / "u.ssp", tiny, document(parts).replace('startTime="0"', 'startTime="-1"'))
    result = fly(path)
    assert result.time.tolist() == [-1 + 0.25 * n for n in range(9)]
