"""Declarations of the package in pyproject.toml, setup.py and the Makefile; the wheel itself is tested in
test_wheel.py.

Truth: the files of the checkout; a Python that reports an old version.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from importlib import import_module

import pytest
import trove_classifiers
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name
from packaging.version import Version

import perilune
from perilune.common.paths import ROOT
from perilune.fmus_src.face import HOME_OF
from tests.package.floors import floors

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
LOCK = {
    canonicalize_name(name): Version(version)
    for name, separator, version in (
        line.partition("==") for line in (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    )
    if separator
}
FILES = """
import json
import os
from setuptools.dist import Distribution
found = Distribution({"long_description": "as setup.py writes it"})
found.parse_config_files()
command = found.get_command_obj("build_py")
command.ensure_finalized()
command.manifest_files = {}  # what git or an older build would add
files = [file for each in command.packages for file in command.find_data_files(each, command.get_package_dir(each))]
print(json.dumps({"packages": command.packages, "files": files}))
"""


def test_all_that_is_not_python_is_packed_under_one_name():
    done = subprocess.run([sys.executable, "-c", FILES], cwd=ROOT, capture_output=True, text=True, check=True)
    actual = json.loads(done.stdout.splitlines()[-1])
    assert {name.split(".")[0] for name in actual["packages"]} == {"perilune"}
    packed = {(ROOT / name).resolve().relative_to(ROOT).as_posix() for name in actual["files"]}
    expected = {"perilune/py.typed", "perilune/__init__.pyi"}
    for room, kinds in {
        "ssp_systems": ("*",),
        "laws": ("*",),
        "fmus_src": ("*.h", "*.png", "*.csv", "*.toml"),
        "analysis": ("*.html", "*.css", "*.jinja", "*.c", "*.h", "*.json"),
    }.items():
        paths = [path for kind in kinds for path in (ROOT / room).rglob(kind) if path.is_file()]
        expected |= {path.relative_to(ROOT).as_posix() for path in paths}
    assert packed == expected


def test_the_citation_is_of_this_version():
    lines = (ROOT / "CITATION.cff").read_text(encoding="utf-8").splitlines()
    declared = dict(line.split(": ", 1) for line in lines if ": " in line and not line.startswith(" "))
    assert declared["version"] == PROJECT["version"]
    assert declared["license"] == PROJECT["license"]
    assert (declared["cff-version"], declared["title"]) == ("1.2.0", "Perilune")


def test_the_head_of_the_changelog_is_what_is_unreleased_or_this_version():
    head = re.findall("^## (.*)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)[0]
    assert head == "Unreleased" or re.fullmatch(rf"{re.escape(PROJECT['version'])} \(\d{{4}}-\d\d-\d\d\)", head)


def test_classifiers_are_known_and_name_the_versions_of_python():
    assert set(PROJECT["classifiers"]) <= trove_classifiers.classifiers
    versions = re.findall(r":: Python :: (3\.\d+)$", "\n".join(PROJECT["classifiers"]), re.MULTILINE)
    permitted = SpecifierSet(PROJECT["requires-python"])
    assert versions == [f"3.{minor}" for minor in range(50) if f"3.{minor}" in permitted]


def test_make_refuses_an_old_python_before_it_makes_anything(tmp_path):
    for name in ("Makefile", "pyproject.toml", "constraints.txt", "setup.py"):
        shutil.copy(ROOT / name, tmp_path)
    old = tmp_path / "python3.9"
    pretend = "import sys; sys.version_info = (3, 9, 1); sys.version = '3.9.1 (old)'; exec(sys.argv[1])"
    old.write_text(f'#!/bin/sh\nexec {sys.executable} -c "{pretend}" "$2"\n')
    old.chmod(0o755)
    before = sorted(tmp_path.iterdir())
    for target in ("demo", "test", "build"):
        done = subprocess.run(
            ["make", target, f"PYTHON={old}"], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.returncode == 2
        first = done.stderr.splitlines()[0]
        assert first.startswith(f"Perilune needs Python 3.11 to 3.13, and {old} is 3.9.1; ")
        assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize(("watched", "quiet"), [(True, False), (False, True)])
def test_make_shows_what_pip_does_on_a_terminal_only(tmp_path, watched, quiet):
    for name in ("Makefile", "pyproject.toml", "constraints.txt", "setup.py"):
        shutil.copy(ROOT / name, tmp_path)
    terminal, end = os.openpty()
    try:
        error = end if watched else subprocess.DEVNULL
        done = subprocess.run(
            ["make", "--dry-run", ".venv/ready"],
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=error,
            text=True,
            check=True,
        )
    finally:
        os.close(terminal)
        os.close(end)
    lines = done.stdout.splitlines()
    assert any("echo 'Installing Perilune" in line for line in lines)
    installs = [line for line in lines if "pip install" in line]
    assert len(installs) == 2
    assert all(("--quiet" in line) == quiet for line in installs)


def test_every_name_for_blocks_is_public() -> None:
    """An FMU's packed files find the names in `face`, a block at work in `perilune`: one list and its stub."""
    assert set(HOME_OF) <= set(perilune.__all__)
    for name in HOME_OF:
        assert getattr(perilune, name) is getattr(import_module(f"perilune.fmus_src.{HOME_OF[name]}"), name)


def test_a_build_has_what_the_documentation_is_made_with() -> None:
    """Return the packages of the lock that a wheel's bill of materials has: dependencies and the extra `docs`."""
    requires = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["build-system"]["requires"]
    pinned = {(each.name, str(each.specifier).removeprefix("==")) for each in map(Requirement, requires)}
    names = [Requirement(each).name for each in (*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["docs"])]
    assert {(name, str(LOCK[canonicalize_name(name)])) for name in names} <= pinned


def test_the_lock_has_all_packages_in_versions_of_their_ranges() -> None:
    extras = [each for extra in PROJECT["optional-dependencies"].values() for each in extra]
    for each in map(Requirement, (*PROJECT["dependencies"], *extras)):
        assert LOCK[canonicalize_name(each.name)] in each.specifier, each


def test_packages_have_a_floor_and_no_ceiling_but_for_breaks() -> None:
    """fmpy's private names are used; later versions of sympy need an older mpmath than ours."""
    requirements = [*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["symbolic"]]
    operators = {Requirement(each).name: {one.operator for one in Requirement(each).specifier} for each in requirements}
    assert all(">=" in each for each in operators.values())
    assert {name for name, each in operators.items() if each != {">="}} == {"fmpy", "sympy"}
    for each, (name, version) in zip(requirements, floors(requirements), strict=True):
        assert Requirement(each).name == name
        assert Version(version) in Requirement(each).specifier
    with pytest.raises(ValueError, match="numpy: no oldest version"):
        list(floors(["numpy"]))
