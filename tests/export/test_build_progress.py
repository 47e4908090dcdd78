"""Building FMUs tells how far it is, where somebody watches.

Truth: how many FMUs are built.
"""

import pytest

from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export import command
from tests.support.bars import watched


@pytest.mark.parametrize("flavour", ["python", "native"])
def test_a_build_tells_how_far_it_is(tmp_path, monkeypatch, capsys, flavour):
    bars = watched(monkeypatch, command, "tqdm")
    two = dict([(name, block) for name, block in catalogue().items() if not block.python_only][:2])
    monkeypatch.setattr(command, "catalogue", lambda: two)
    monkeypatch.setattr(command, "SYSTEMS", tmp_path)  # which has none: FMUs alone
    assert command.main(["--output", str(tmp_path / "build"), "--flavour", flavour]) == 0
    assert bars.ends == [(2, 2)]
    assert f"2 {flavour} FMUs in" in capsys.readouterr().out


def test_a_build_is_silent_in_a_log(tmp_path, monkeypatch, capsys):
    one = dict(list(catalogue().items())[:1])
    monkeypatch.setattr(command, "catalogue", lambda: one)
    monkeypatch.setattr(command, "SYSTEMS", tmp_path)
    assert command.main(["--output", str(tmp_path / "build"), "--flavour", "python"]) == 0
    assert capsys.readouterr().err == ""
