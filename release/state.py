"""The checkout as a release needs it, and the files that a release writes."""

from __future__ import annotations

import re
import subprocess
import tomllib
from dataclasses import dataclass
from datetime import UTC, date, datetime, time
from pathlib import Path

from perilune.common.errors import InputError

HEADING = re.compile(r"^## (.+)$", re.MULTILINE)
UNRELEASED = "Unreleased"


@dataclass(frozen=True)
class Release:
    """A version with its day, UTC."""

    version: str
    day: date

    @property
    def tag(self) -> str:
        """Name of the git tag."""
        return f"v{self.version}"

    @property
    def heading(self) -> str:
        """The text of its section's heading in CHANGELOG.md."""
        return f"{self.version} ({self.day.isoformat()})"

    @property
    def epoch(self) -> int:
        """SOURCE_DATE_EPOCH: the first second of the day, in s since 1970."""
        return int(datetime.combine(self.day, time(), UTC).timestamp())


def git(root: Path, *arguments: str) -> bytes:
    """Return what a git command prints. Raises CalledProcessError where it fails."""
    return subprocess.run(["git", *arguments], cwd=root, capture_output=True, check=True).stdout


def read_release(root: Path, day: date) -> Release:
    """Return the release that a checkout is ready for. Raises InputError where it is not."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    release = Release(project["version"], day)
    if not project.get("urls"):
        remedy = 'write the address of the sources, such as Repository = "https://..."'
        raise InputError(
            "pyproject.toml", "[project.urls]", "missing; a package index would not link to the sources", remedy
        )
    _check_headings(release, (root / "CHANGELOG.md").read_text(encoding="utf-8"))
    if f"\nversion: {release.version}\n" not in (root / "CITATION.cff").read_text(encoding="utf-8"):
        raise InputError("CITATION.cff", "version", f"not {release.version} as in pyproject.toml", "write it there too")
    if git(root, "status", "--porcelain"):
        raise InputError(str(root), "git status", "the tree is dirty", "commit or stash the changes")
    if git(root, "tag", "--list", release.tag):
        remedy = "raise the version in pyproject.toml and CITATION.cff"
        raise InputError("pyproject.toml", "version", f"the tag {release.tag} exists", remedy)
    return release


def _check_headings(release: Release, changelog: str) -> None:
    headings = HEADING.findall(changelog)
    if not headings or headings[0] != UNRELEASED:
        first = f"## {headings[0]}" if headings else "nothing"
        raise InputError(
            "CHANGELOG.md", first, f"stands in the place of ## {UNRELEASED}", f"list the changes below ## {UNRELEASED}"
        )
    sections = HEADING.split(changelog)[1:]
    if not sections[1].strip():
        raise InputError("CHANGELOG.md", f"## {UNRELEASED}", "empty", "list the changes")
    if release.version in {each.partition(" ")[0] for each in headings}:
        remedy = "raise the version in pyproject.toml and CITATION.cff"
        raise InputError("CHANGELOG.md", f"## {release.version}", "released before", remedy)


def written_files(release: Release, root: Path) -> dict[Path, str]:
    """Return the new text of each file that says the version's day: changelog, FMUs' date, citation."""
    day = release.day
    changes = {
        "CHANGELOG.md": (rf"^## {UNRELEASED}$", f"## {release.heading}"),
        "CITATION.cff": (r"^version: .*$(\ndate-released: .*)?", f"version: {release.version}\ndate-released: {day}"),
        "fmus_src/export/description/origin.py": (
            r"^RELEASED = .*$",
            f"RELEASED = datetime({day.year}, {day.month}, {day.day}, tzinfo=UTC)",
        ),
    }
    texts = {}
    for name, (pattern, replacement) in changes.items():
        text = (root / name).read_text(encoding="utf-8")
        texts[root / name], count = re.subn(pattern, replacement, text, count=1, flags=re.MULTILINE)
        if count != 1:
            raise InputError(name, pattern, "not found", "write it as the last release did")
    return texts
