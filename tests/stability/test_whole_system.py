"""Stability of the complete system: states that a loop neither controls nor observes must not grow.

Truth: python-control on the pendulum without its controller; the closed form of its hold.
"""

import json
import warnings

import control
import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.stability.point.modes import find_coupled_cells, multipliers
from tests.support.builders import component, inline, pack
from tests.support.loops.exact_systems import pendulum
from tests.support.loops.studies import foreign_system

NOTHING = {"control.proportional": 0.0, "control.derivative": 0.0}
STEP, RATE = 0.05, 1.2


def falling(every):
    """Return multipliers of the pendulum alone over ``every`` steps."""
    plant = control.c2d(control.ss(control.tf(1.0, [1.0, 0.0, -(RATE**2)])), every * STEP, "zoh")
    return max(abs(plant.poles()))


@pytest.mark.parametrize("every", [1, 4])
def test_nothing_holds_a_pendulum(every, exact_fmus, tmp_path):
    """The loop has no gain, so that it neither moves nor sees what falls."""
    path = pendulum(every).packed(tmp_path, exact_fmus)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        report = perilune.stability(path, set=NOTHING)
        json.dumps(report.to_json(), allow_nan=False)
    (loop,) = report.loops
    assert not np.any(loop.curve.value)
    assert (loop.stable, loop.verdict, report.verdict) == (False, "fail", "fail")
    assert loop.largest == pytest.approx(falling(every), abs=1e-8)
    assert loop.largest == pytest.approx(np.exp(RATE * every * STEP), abs=1e-8)
    assert any(name.startswith("plant.") for name in loop.outside)
    assert loop.agreement.agrees
    assert [mode.kind for mode in loop.modes if abs(mode.z) > 1.0] == ["not observable"]
    assert loop.margins.unstable


def test_its_command_says_so(exact_fmus, tmp_path, capsys):
    path = str(pendulum().packed(tmp_path, exact_fmus))
    actual = tmp_path / "z.json"
    words = [token for name in NOTHING for token in ("--set", f"{name}=0")]
    assert main(["stability", path, *words, "--json", str(actual)]) == 1
    (loop,) = json.loads(actual.read_text())["loops"]
    assert (loop["stable"], loop["gain_margin_db"], loop["verdict"]) == (False, "unstable", "fail")
    captured = capsys.readouterr()
    assert f"unstable, spectral radius {falling(1):.4g}, linearised and measured responses agree: fail" in captured.out
    assert "none of the injected signal returns" in captured.out
    assert "the instability is outside of this loop: plant." in captured.err


def test_a_pendulum_beside_the_loop(exact_fmus, tmp_path):
    """No connection with a loop that is stable in itself."""
    exact = pendulum()
    beside = component("beside", "held_pendulum", "output position Real", inline(f"rate=Real:{RATE}"))
    path = pack(tmp_path / "two.ssp", exact_fmus, exact.ssd.replace("</ssd:Elements>", f"{beside}</ssd:Elements>"))
    (loop,) = perilune.stability(path).loops
    assert loop.stable is False
    assert loop.largest == pytest.approx(falling(1), abs=1e-8)
    assert all(name.startswith("beside.") for name in loop.outside)
    own = [mode.z for mode in loop.modes if mode.kind == "loop"]
    nearest = np.min(abs(np.array(own)[:, None] - exact.closed[None]), axis=1)
    assert nearest.max() < 1e-8
    assert [mode.kind for mode in loop.modes if abs(mode.z) > 1.0] == ["neither"]


@pytest.mark.slow
def test_over_a_parameter_that_a_loop_does_not_see(exact_fmus, tmp_path):
    """A sweep of the pendulum outside it: stable at no rate, unstable at any."""
    exact = pendulum()
    beside = component("beside", "held_resonance", "output position Real", inline("rate=Real:2; damping=Real:0.1"))
    sweep = '<Sweep name="d" loop="loop" point="there" parameter="beside.damping" low="-0.2" high="0.2"/>'
    ssd = exact.ssd.replace("</ssd:Elements>", f"{beside}</ssd:Elements>").replace(
        "</Stability>", f"{sweep}</Stability>"
    )
    report = perilune.stability(pack(tmp_path / "two.ssp", exact_fmus, ssd))
    assert report.loops[0].stable
    (actual,) = report.sweeps
    assert [item.unstable for item in actual.margins] == [value < -1e-4 for value in actual.values]
    (crossing,) = (item for item in actual.crossings if item.quantity == "stability")
    assert crossing.below
    assert crossing.value == pytest.approx(0.0, abs=1e-3)


def test_a_loop_of_foreign_fmus_without_gain_has_no_verdict(tmp_path):
    report = perilune.stability(foreign_system(tmp_path), loops=["law.y"], at=1.0, set={"law.gain": 0.0})
    assert (report.loops, report.verdict) == ((), "not applicable")
    (lost,) = report.unstudied
    assert lost.reason == "no signal returns downstream of law"


def test_blocks_of_a_matrix():
    """Two masses on springs of their own, an integrator of both, and a delay: eigenvalues of the whole matrix."""
    random = np.random.default_rng(1)
    whole = np.zeros((6, 6))
    whole[:2, :2], whole[2:4, 2:4] = random.normal(size=(2, 2, 2))
    whole[4, :5] = 1.0  # adds up
    whole[5, 4] = 1.0  # is forgotten
    order = random.permutation(6)
    mixed = whole[np.ix_(order, order)]
    actual = np.concatenate([multipliers(mixed, cells) for cells in find_coupled_cells(mixed)])
    exact = np.linalg.eigvals(whole[:4, :4])
    assert sorted(abs(actual)) == pytest.approx(sorted(abs(exact)), rel=1e-12)
