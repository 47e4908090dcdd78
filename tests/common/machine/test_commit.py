"""perilune.common.machine.commit: the commit that `perilune --version` prints.

Truth: `git rev-parse` in a repository of the test, and the file defined by PEP 610.
"""

from __future__ import annotations

import json
import subprocess

import pytest

from perilune.analysis.cli import main
from perilune.common.machine import commit
from perilune.common.machine.commit import commit_of_checkout, commit_of_origin


@pytest.fixture
def repository(tmp_path):
    """Return a repository with one commit, and the commit's whole name."""
    (tmp_path / "file").write_text("1")
    who = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false"]
    for line in (["init", "-q"], ["add", "file"], [*who, "commit", "-qm", "first"], ["tag", "-m", "t", "v1"]):
        subprocess.run(["git", *(who if line[0] == "tag" else []), *line], cwd=tmp_path, check=True)
    named = subprocess.run(["git", "rev-parse", "HEAD"], cwd=tmp_path, capture_output=True, text=True, check=True)
    return tmp_path, named.stdout.strip()


def test_a_checkout_has_its_commit(repository):
    folder, name = repository
    assert commit_of_checkout(folder) == name[:12]
    (folder / "file").write_text("2")
    assert commit_of_checkout(folder) == f"{name[:12]}, modified"


def test_a_folder_inside_another_repository_has_none(repository):
    folder, _ = repository
    (folder / "inner").mkdir()
    assert commit_of_checkout(folder / "inner") == ""


def test_without_git_there_is_none(repository, monkeypatch):
    monkeypatch.setenv("PATH", "")
    assert commit_of_checkout(repository[0]) == ""


def test_an_installation_from_a_repository_has_its_commit():
    name = "0123456789abcdef0123456789abcdef01234567"
    url = {"url": "https://example.org/x.git", "vcs_info": {"vcs": "git", "commit_id": name}}
    assert commit_of_origin(json.dumps(url)) == name[:12]
    assert commit_of_origin(json.dumps({"url": "file:///x.whl", "archive_info": {}})) == ""
    assert commit_of_origin(None) == ""


def test_the_version_has_the_commit_where_there_is_one(repository, monkeypatch, capsys):
    folder, name = repository
    for root, expected in ((folder, f" (commit {name[:12]})"), (folder / "none", "")):
        monkeypatch.setattr(commit, "ROOT", root)
        with pytest.raises(SystemExit, match="0"):
            main(["--version"])
        assert capsys.readouterr().out.partition(" ")[2].rstrip().endswith(f"0{expected}")
