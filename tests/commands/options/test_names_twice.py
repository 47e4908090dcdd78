"""File of the working folder with the name of a campaign or parameter set of a system.

Truth: the contents of the two files; the line on standard error, which names both.
"""

from __future__ import annotations

import json
import shutil
import warnings

import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common.paths import SYSTEMS

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"
BATCH = ["batch", SYSTEM, "--compare", "guidance=analytic_guidance", "--trials", "2", "--workers", "1"]


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Return a working folder with a campaign and a parameter set of names that the system has, but other content."""
    monkeypatch.chdir(tmp_path)
    (campaign,) = (SYSTEMS / SYSTEM).rglob("paper.toml")
    text = campaign.read_text()
    assert "seed = 20170700" in text
    (tmp_path / "paper.toml").write_text(text.replace("seed = 20170700", "seed = 5"))
    (source,) = (SYSTEMS / SYSTEM).rglob("noisy.ssv")
    text = source.read_text()
    assert 'value="20" unit="m"' in text
    (tmp_path / "noisy.ssv").write_text(text.replace('value="20" unit="m"', 'value="40" unit="m"', 1))
    return tmp_path


def remarks(command: list[str], capsys) -> tuple[list[str], dict]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        main([*command, "--json", "-"])
    return list(dict.fromkeys(str(item.message) for item in caught)), json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("name", ["paper", "paper.toml"])
def test_a_campaign(name, here, capsys):
    said, actual = remarks([*BATCH, "--campaign", name], capsys)
    assert actual["seed"] == 20170700
    (line,) = said
    assert line.startswith(f"`campaign` {name}: read from ssp_systems/{SYSTEM}!")
    assert line.endswith("paper.toml in the working folder; write `campaign` ./paper.toml to use that file")
    said, actual = remarks([*BATCH, "--campaign", "./paper.toml"], capsys)
    assert (said, actual["seed"]) == ([], 5)


def test_a_parameter_set(here, capsys):
    said, actual = remarks(["run", SYSTEM, "--parameters", "noisy.ssv"], capsys)
    (line,) = said
    assert line.startswith(f"`parameters` noisy.ssv: read from ssp_systems/{SYSTEM}!resources/noisy.ssv, not from")
    assert line.endswith("write `parameters` ./noisy.ssv to use that file")
    said, other = remarks(["run", SYSTEM, "--parameters", "./noisy.ssv"], capsys)
    assert said == []
    assert other["final"] != actual["final"]


def test_from_python(here):
    with pytest.warns(UserWarning, match="not from the different file noisy.ssv in the working folder"):
        perilune.simulate(SYSTEM, parameters=["noisy.ssv"])


def test_the_same_file_is_no_other(here, capsys):
    (source,) = (SYSTEMS / SYSTEM).rglob("noisy.ssv")
    shutil.copy(source, here / "noisy.ssv")
    (here / "paper.toml").unlink()
    assert remarks(["run", SYSTEM, "--parameters", "noisy.ssv"], capsys)[0] == []
    assert remarks([*BATCH, "--campaign", "paper"], capsys)[0] == []
