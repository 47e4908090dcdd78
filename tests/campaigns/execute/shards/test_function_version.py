"""Campaign with a different version of the elementary functions: its folder is read, but cannot be extended.

Truth: the manifest as written, with its version changed, or removed as in folders of older versions.
"""

from __future__ import annotations

import json

import pytest

from perilune.analysis.campaigns.execute import loaded_campaign
from perilune.analysis.campaigns.execute import plan_manifest as gather
from perilune.analysis.cli import main
from perilune.fmus_src.kernel.functions import VERSION

pytestmark = pytest.mark.usefixtures("fmus")
CAMPAIGN = ["lunar_terminal_guidance", "--campaign", "paper", "--trials", "30"]
FIELD = "elementary_functions"


@pytest.fixture
def folder(tmp_path):
    """Prepare a campaign with none of its shards."""
    assert main(["prepare", *CAMPAIGN, "--output", str(tmp_path / "out")]) == 0
    return tmp_path / "out"


def rewrite(folder, version):
    """Change the version of the functions in the manifest, or remove it."""
    path = folder / "manifest.json"
    document = json.loads(path.read_text())
    assert document.pop(FIELD) == VERSION
    path.write_text(json.dumps(document if version is None else {**document, FIELD: version}))


@pytest.mark.parametrize("version", [None, VERSION + 1])
def test_shards_are_not_simulated_with_other_functions(folder, version, capsys):
    rewrite(folder, version)
    capsys.readouterr()
    assert main(["shard", str(folder), "0"]) == 2
    error = capsys.readouterr().err
    assert f"{folder}: {FIELD}: prepared with elementary functions {version}, but this perilune has {VERSION}" in error
    assert error.count("\n") == 1
    assert not list((folder / "trials").glob("*.parquet"))


@pytest.mark.parametrize("version", [None, VERSION + 1])
def test_a_campaign_is_not_resumed_with_other_functions(folder, version, capsys, refusal):
    rewrite(folder, version)
    capsys.readouterr()
    assert f"{FIELD} was {'nothing' if version is None else version}, is {VERSION}" in refusal(
        ["batch", *CAMPAIGN, "--output", str(folder), "--resume"]
    )


def test_a_complete_folder_of_an_older_version_is_read(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(gather, "VERSION", None)  # as before there was one
    monkeypatch.setattr(loaded_campaign, "VERSION", None)
    out = tmp_path / "out"
    assert main(["batch", *CAMPAIGN, "--output", str(out)]) in (0, 1)
    monkeypatch.undo()
    assert FIELD not in json.loads((out / "manifest.json").read_text())
    capsys.readouterr()
    assert main(["compare", str(out)]) == 0
    assert "analytic_guidance" in capsys.readouterr().out
