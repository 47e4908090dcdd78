"""Fused steps compiled during a campaign, if the remaining trials justify the compilation.

Truth: the same campaign without fused steps, file by file.
"""

import pytest

import perilune
from perilune.analysis.campaigns.execute import fusing
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.fused import fuse, refusals

SYSTEM, CAMPAIGN = "lunar_terminal_guidance", "noisy"
OPTIONS = {"configuration": "analytic_guidance", "stop_time": 5.0, "trials": 1200, "workers": 2}
pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture
def fused(monkeypatch):
    """Record the systems of simulations whose steps are compiled under way."""
    systems = []
    original = Simulation.fuse

    def note(simulation):
        original(simulation)
        systems.append(simulation.fused_steps != 0)

    monkeypatch.setattr(Simulation, "fuse", note)
    return systems


def files_of(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_same_files(fused, monkeypatch, tmp_path):
    monkeypatch.setattr(fusing, "COMPILATION", 0.0)
    perilune.batch(SYSTEM, CAMPAIGN, output=tmp_path / "chosen", **OPTIONS)
    assert fused
    assert all(fused)
    monkeypatch.setattr(fusing, "COMPILATION", 1e9)
    count = len(fused)
    perilune.batch(SYSTEM, CAMPAIGN, output=tmp_path / "native", **OPTIONS)
    assert len(fused) == count
    assert files_of(tmp_path / "chosen") == files_of(tmp_path / "native")


@pytest.mark.parametrize("flavour", [None, "native"])
def test_not_where_it_does_not_pay_nor_with_a_flavour(fused, monkeypatch, flavour):
    """A fifth of a second of trials; with `native` however much it would pay."""
    if flavour is not None:
        monkeypatch.setattr(fusing, "COMPILATION", 0.0)
    perilune.batch(SYSTEM, CAMPAIGN, flavour=flavour, **OPTIONS)
    assert not fused


def test_nor_without_a_compiler(fused, monkeypatch):
    monkeypatch.setattr(fusing, "COMPILATION", 0.0)
    monkeypatch.setattr(refusals, "available_platforms", list)
    perilune.batch(SYSTEM, CAMPAIGN, **OPTIONS)
    assert not any(fused)


def test_a_compiler_that_fails_is_said_once(fused, monkeypatch):
    """The trials are those without it."""
    monkeypatch.setattr(fusing, "COMPILATION", 0.0)
    monkeypatch.setattr(fuse, "FLAGS", (*fuse.FLAGS, "-fno-such-flag"))
    options = OPTIONS | {"workers": 1}
    with pytest.warns(
        UserWarning, match="steps are not compiled: the compiler rejects the C code of the steps"
    ) as noted:
        result = perilune.batch(SYSTEM, CAMPAIGN, **options)
    assert len(noted) == 1
    assert not any(fused)
    expected = perilune.batch(SYSTEM, CAMPAIGN, flavour="native", **options)
    assert repr(result.table().to_pydict()) == repr(expected.table().to_pydict())
