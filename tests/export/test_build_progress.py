"""Progress of building FMUs is shown on a terminal.

Truth: the number of built FMUs.
"""

import pytest

from perilune.analysis import shipped
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export import build
from tests.support.bars import watched


@pytest.mark.parametrize("flavour", ["python", "native"])
def test_a_build_tells_how_far_it_is(tmp_path, monkeypatch, capsys, flavour):
    bars = watched(monkeypatch, build, "tqdm")
    two = dict([(name, block) for name, block in catalogue().items() if not block.python_only][:2])
    monkeypatch.setattr(build, "catalogue", lambda: two)
    monkeypatch.setattr(shipped, "SYSTEMS", tmp_path)  # which has none: FMUs alone
    assert shipped.main(["--output", str(tmp_path / "build"), "--flavour", flavour]) == 0
    assert bars.ends == [(2, 2)]
    assert f"2 {flavour} FMUs in" in capsys.readouterr().out


def test_a_build_is_silent_in_a_log(tmp_path, monkeypatch, capsys):
    one = dict(list(catalogue().items())[:1])
    monkeypatch.setattr(build, "catalogue", lambda: one)
    monkeypatch.setattr(shipped, "SYSTEMS", tmp_path)
    assert shipped.main(["--output", str(tmp_path / "build"), "--flavour", "python"]) == 0
    assert capsys.readouterr().err == ""
