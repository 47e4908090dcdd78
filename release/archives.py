"""The archives of a release: built with its date, compared to the byte, read as a package index reads them."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

from lxml import html
from packaging.metadata import Metadata
from readme_renderer import markdown

from perilune.common.errors import InputError

from .state import Release

SDIST = "import sys; from setuptools.build_meta import build_sdist; build_sdist(sys.argv[1])"
WHEEL = ("-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", ".", "--wheel-dir")


def build_sdist(tree: Path, folder: Path, release: Release) -> Path:
    """Write the source distribution of a tree into a folder and return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    _run(["-c", SDIST, str(folder)], tree, release)
    return _only(folder, "*.tar.gz")


def build_wheel(tree: Path, folder: Path, release: Release) -> Path:
    """Write the wheel of a tree, or of an unpacked source distribution, into a folder and return its path."""
    _run([*WHEEL, str(folder)], tree, release)
    return _only(folder, "*.whl")


def require_same_bytes(first: Path, second: Path) -> None:
    """Raise InputError with the first member that two archives do not have alike, unless they are the same bytes."""
    if first.read_bytes() == second.read_bytes():
        return
    members, others = _members(first), _members(second)
    names = [name for name in sorted({*members, *others}) if members.get(name) != others.get(name)]
    element = names[0] if names else "dates, modes or order of its members"
    raise InputError(str(first), element, f"not as in {second}", "find the cause of the difference")


def check_wheel(wheel: Path, release: Release) -> None:
    """Raise InputError where the wheel lacks `py.typed`, is of another version, or its page does not render."""
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        (about,) = [name for name in names if name.endswith(".dist-info/METADATA")]
        metadata = Metadata.from_email(archive.read(about))
    if "perilune/py.typed" not in names:
        raise InputError(str(wheel), "perilune/py.typed", "missing", "see package-data in pyproject.toml")
    if str(metadata.version) != release.version:
        raise InputError(str(wheel), f"version {metadata.version}", f"not {release.version}", "see pyproject.toml")
    check_page(metadata.description or "")


def check_page(description: str) -> None:
    """Raise InputError where the page of a package index would not render, or have links to files that it lacks."""
    problems = io.StringIO()
    page = markdown.render(description, stream=problems)
    if not page:
        raise InputError("README.md", "long description", f"does not render: {problems.getvalue()}", "see setup.py")
    for element in html.fromstring(page).iter("a", "img"):
        target = element.get("href") or element.get("src") or ""
        if not target.startswith(("https://", "http://", "#")):
            raise InputError("README.md", target, "is a dead link on a package index", "see index_page in setup.py")


def _run(arguments: list[str], tree: Path, release: Release) -> None:
    """Run Python in a tree, with the date of the release and with no other checkout in its path."""
    environment = {name: text for name, text in os.environ.items() if name != "PYTHONPATH"}
    environment["SOURCE_DATE_EPOCH"] = str(release.epoch)
    done = subprocess.run(
        [sys.executable, *arguments], cwd=tree, env=environment, capture_output=True, text=True, check=False
    )
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        raise InputError(str(tree), "build", "\n".join(["failed", *lines[-20:]]), "see the lines above")


def _only(folder: Path, pattern: str) -> Path:
    (path,) = folder.glob(pattern)
    return path


def _members(path: Path) -> dict[str, bytes]:
    """Return the content of each file of an archive by its name."""
    if path.suffix == ".whl":
        with zipfile.ZipFile(path) as archive:
            return {name: archive.read(name) for name in archive.namelist()}
    with tarfile.open(path) as archive:
        files = [member for member in archive if member.isfile()]
        return {member.name: content.read() for member in files if (content := archive.extractfile(member))}
