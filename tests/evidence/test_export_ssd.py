"""`perilune export X.ssd` writes the system that `perilune run X.ssd` simulates.

Truth: both simulations, equal to the last bit.
"""

from __future__ import annotations

import re
import shutil

import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common.paths import SYSTEMS

pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Return a copy of a system with a second description, of another communication step."""
    monkeypatch.chdir(tmp_path)
    copy = shutil.copytree(SYSTEMS / "lunar_terminal_guidance", tmp_path / "mine")
    text = (copy / "SystemStructure.ssd").read_text(encoding="utf-8")
    other = re.sub(r'(CommunicationStep [^>]*size=")[^"]*', r"\g<1>0.5", text)
    assert other != text
    (copy / "coarse.ssd").write_text(other, encoding="utf-8")
    return copy


@pytest.mark.parametrize(("ssd", "name"), [("coarse.ssd", "coarse.ssp"), ("SystemStructure.ssd", "mine.ssp")])
def test_the_archive_is_what_run_simulates(folder, capsys, ssd, name):
    assert main(["export", f"mine/{ssd}"]) == 0
    assert capsys.readouterr().out == f"{name}\n"
    expected = perilune.simulate(f"mine/{ssd}", stop_time=5.0)
    actual = perilune.simulate(name, stop_time=5.0)
    assert actual.time.tolist() == expected.time.tolist()
    assert actual.final() == expected.final()
