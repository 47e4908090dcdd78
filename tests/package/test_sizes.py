"""Sizes stated in README and docs equal the sizes stored by `make sizes`.

Truth: release/sizes.json; for sums, files of known length and pip's list of files.
"""

from __future__ import annotations

import json
import re

from perilune.common.paths import ROOT
from release.sizes import STORED, TOOLS, size_of, sizes_by_package
from tests.package.test_packaging import PROJECT

SIZES = json.loads(STORED.read_text(encoding="utf-8"))


def megabytes(size: int) -> str:
    """Return a size in bytes as pages state it."""
    return f"{size / 1e6:.0f}"


def test_the_table_of_readme_is_what_was_measured():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| `perilune(?:\[(\w+)\])?` \| (\d+) \|", text, re.MULTILINE))
    assert rows == {extra: megabytes(size) for extra, size in SIZES["installed"].items()}
    assert set(rows) - {""} == set(PROJECT["optional-dependencies"]) - set(TOOLS)


def test_the_largest_packages_are_those_of_the_decisions():
    text = (ROOT / "docs" / "decisions.md").read_text(encoding="utf-8")
    (line,) = [each for each in text.splitlines() if each.startswith("- **Size of an installation")]
    stated = re.findall(r"([\w-]+) (\d+)(?:,| and|;)", line.partition("MB:")[2])
    largest = list(SIZES["packages"].items())[: len(stated)]
    assert len(stated) > 4
    assert stated == [(name, megabytes(size)) for name, size in largest]


def test_the_size_of_the_wheel_is_what_was_measured():
    (stated,) = re.findall(r"The wheel \(([\d.]+) MB;", (ROOT / "docs/use_elsewhere.md").read_text(encoding="utf-8"))
    assert stated == f"{SIZES['wheel'] / 1e6:.1f}"


def test_files_are_added_up(tmp_path):
    """A package of three files, one of which is listed twice."""
    site = tmp_path / "site-packages"
    about = site / "some-1.dist-info"
    about.mkdir(parents=True)
    (site / "some.py").write_bytes(b"x" * 100)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: some\nVersion: 1\n")
    (about / "RECORD").write_text("some.py,,\nsome.py,,\nsome-1.dist-info/METADATA,,\nsome-1.dist-info/RECORD,,\n")
    sizes = [path.stat().st_size for path in (site / "some.py", about / "METADATA", about / "RECORD")]
    assert size_of(site) == sum(sizes)
    assert sizes_by_package(site) == {"some": sum(sizes)}
