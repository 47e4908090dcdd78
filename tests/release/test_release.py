"""Release of a small checkout: refusals, written files, commit and tag; comparison of archives and pages.

Truth: the answers of git, hand-written archives, HTML written by readme_renderer.
"""

from __future__ import annotations

import re
import shutil
import tarfile
import tomllib
import zipfile
from datetime import date
from pathlib import Path

import pytest

from perilune.common.errors import InputError
from perilune.common.paths import ROOT
from release.__main__ import main, publish_locally
from release.archives import build_sdist, check_page, check_wheel, require_same_bytes
from release.state import Release, git, read_release
from tests.support.installed import copy_of_checkout

VERSION = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
DAY = date(2027, 2, 3)
URLS = '[project.urls]\nRepository = "https://example.org/sources"\n'
ORIGIN = "fmus_src/export/description/origin.py"


@pytest.fixture
def checkout(tmp_path):
    """Return a committed tree with the files that a release reads, and an address of the sources."""
    root = tmp_path / "checkout"
    for name in ("CITATION.cff", ORIGIN):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, root / name)
    (root / "pyproject.toml").write_text(f'[project]\nversion = "{VERSION}"\n{URLS}')
    (root / "CHANGELOG.md").write_text("# Changelog\n\n## Unreleased\n- news\n\n## 0.0.9 (2026-01-02)\n- before\n")
    git(root, "init", "--quiet")
    git(root, "config", "user.name", "Tester")
    git(root, "config", "user.email", "tester@example.org")
    commit(root)
    return root


def commit(root: Path) -> None:
    """Commit all that there is."""
    git(root, "add", "--all")
    git(root, "commit", "--quiet", "--message", "x")


def replace(file: Path, old: str, new: str) -> None:
    """Replace a text that stands in a file."""
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "old", "new", "message"),
    [
        ("pyproject.toml", URLS, "", "pyproject.toml: [project.urls]: missing"),
        ("pyproject.toml", f'"{VERSION}"', '"99.2.0"', "CITATION.cff: version: not 99.2.0 as in pyproject.toml; write"),
        (
            "CHANGELOG.md",
            "## Unreleased\n",
            "",
            "CHANGELOG.md: ## 0.0.9 (2026-01-02): stands in the place of ## Unreleased; ",
        ),
        ("CHANGELOG.md", "- news", "", "CHANGELOG.md: ## Unreleased: empty; list the changes"),
        ("CHANGELOG.md", "0.0.9", VERSION, f"CHANGELOG.md: ## {VERSION}: released before; raise the version"),
    ],
)
def test_what_is_refused(checkout, capsys, name, old, new, message):
    replace(checkout / name, old, new)
    commit(checkout)
    before = git(checkout, "rev-parse", "HEAD")
    assert main(["--root", str(checkout)]) == 2
    error = capsys.readouterr().err
    assert error.startswith(f"release: {message}")
    assert error.count("\n") == 1
    assert (git(checkout, "rev-parse", "HEAD"), git(checkout, "tag")) == (before, b"")


def test_a_dirty_tree_and_a_tag_that_exists_are_refused(checkout, capsys):
    (checkout / "new.py").write_text("")
    assert main(["--root", str(checkout)]) == 2
    assert "git status: the tree is dirty; commit or stash" in capsys.readouterr().err
    commit(checkout)
    git(checkout, "tag", f"v{VERSION}")
    assert main(["--root", str(checkout)]) == 2
    assert capsys.readouterr().err.startswith(f"release: pyproject.toml: version: the tag v{VERSION} exists; raise")


def test_the_day_is_written_committed_and_tagged(checkout):
    release = read_release(checkout, DAY)
    publish_locally(release, checkout)
    changelog = (checkout / "CHANGELOG.md").read_text()
    assert re.findall("^## .*", changelog, re.MULTILINE) == [f"## {VERSION} (2027-02-03)", "## 0.0.9 (2026-01-02)"]
    assert "\nRELEASED = datetime(2027, 2, 3, tzinfo=UTC)\n" in (checkout / ORIGIN).read_text()
    assert f"\nversion: {VERSION}\ndate-released: 2027-02-03\n" in (checkout / "CITATION.cff").read_text()
    assert git(checkout, "describe", "--exact-match") == f"v{VERSION}\n".encode()
    assert git(checkout, "status", "--porcelain") == b""
    assert release.epoch == 1801612800  # date --date 2027-02-03Z +%s


def test_archives_that_differ_are_refused(tmp_path):
    for name, text in (("a.whl", "1"), ("b.whl", "2"), ("c.whl", "1")):
        with zipfile.ZipFile(tmp_path / name, "w") as archive:
            archive.writestr(zipfile.ZipInfo("x/y.py"), text)
    require_same_bytes(tmp_path / "a.whl", tmp_path / "c.whl")
    with pytest.raises(InputError, match=r"a\.whl: x/y\.py: not as in .*b\.whl"):
        require_same_bytes(tmp_path / "a.whl", tmp_path / "b.whl")


@pytest.mark.parametrize(
    ("version", "name", "message"),
    [("0.1.0", "perilune/typed", "py.typed: missing"), ("0.1.1", "perilune/py.typed", "version 0.1.1: not 0.1.0")],
)
def test_a_wheel_that_lacks_something_is_refused(tmp_path, version, name, message):
    with zipfile.ZipFile(tmp_path / "x.whl", "w") as archive:
        archive.writestr(name, "")
        archive.writestr("x.dist-info/METADATA", f"Metadata-Version: 2.4\nName: perilune\nVersion: {version}\n")
    with pytest.raises(InputError, match=message):
        check_wheel(tmp_path / "x.whl", Release("0.1.0", DAY))


def test_a_link_that_an_index_has_no_file_for_is_refused():
    check_page("[a](https://example.org) and [b](#b)")
    for target in ("docs/x.md", "LICENSE"):
        with pytest.raises(InputError, match=f"README.md: {target}: is a dead link"):
            check_page(f"[a]({target})")


def test_the_source_distribution(tmp_path):
    """Dates, modes and owners are those of a release; the page for an index has the text of README.md."""
    release = Release(VERSION, DAY)
    with tarfile.open(build_sdist(copy_of_checkout(tmp_path / "tree"), tmp_path, release)) as archive:
        members = archive.getmembers()
        content = archive.extractfile(f"perilune-{VERSION}/PKG-INFO").read().decode()
    assert {(each.mtime, each.mode, each.uid, each.uname) for each in members} == {(release.epoch, 0o644, 0, "")}
    headers, _, page = content.partition("\n\n")
    assert "Description-Content-Type: text/markdown" in headers
    check_page(page)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert re.findall("^#.*", page, re.MULTILINE) == re.findall("^#.*", readme, re.MULTILINE)
    assert "whose result is displayed in a notebook" in page
