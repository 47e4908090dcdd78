"""Accompanying files and attributes of an FMU: origin, licences, icon.

Truth: LICENSE, pyproject.toml, the text of the headers, the signature of PNG files (ISO/IEC 15948), FMPy's validation.
"""

from __future__ import annotations

import shutil
import tomllib
import zipfile
from datetime import datetime
from pathlib import Path

import pytest
from fmpy.validation import validate_fmu
from lxml import etree

from perilune.common.errors import InputError
from perilune.common.paths import CACHE, SYSTEMS, shipped_fmu
from perilune.fmus_src.block import Block, Output
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.description.origin import RELEASED
from perilune.fmus_src.export.native_fmu import build_native_fmu, native_guid
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from tests.support.native.building import fmi3_fmu
from tests.support.native.system_fmus import build_one

ROOT = Path(__file__).parents[3]
NAME = "rate_gyros"
PNG = b"\x89PNG\r\n\x1a\n"


class Ours(Block):
    """A user's block."""

    y = Output(0.0, description="twice the time")

    def step(self, t: float, h: float) -> None:
        self.y = 2.0 * (t + h)


def build(block: type[Block], folder: Path, fmi: int = 2) -> Path:
    """Build the native FMU of a block for this machine."""
    platform = local_platform(fmi)
    if platform is None:
        pytest.skip("no library for this machine")
    return build_native_fmu(block, folder / f"{block.fmu_name}.fmu", platforms=[platform], cache=CACHE, fmi=fmi)


def read(fmu: Path) -> tuple[dict[str, str], dict[str, bytes]]:
    """Return the attributes of modelDescription.xml, and all files."""
    with zipfile.ZipFile(fmu) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    return {str(k): str(v) for k, v in etree.fromstring(files["modelDescription.xml"]).attrib.items()}, files


@pytest.fixture(params=["native", "python", "fmi3"])
def shipped(request: pytest.FixtureRequest, fmus: Path) -> tuple[str, Path]:
    """Return a shipped FMU in each of its forms."""
    if request.param == "fmi3":
        if local_platform(3) is None:
            pytest.skip("FMI 3.0 libraries are not compiled for this system")
        return request.param, fmi3_fmu(catalogue()[NAME])
    return request.param, shipped_fmu(NAME, request.param)


def test_a_shipped_fmu_says_where_it_is_from(shipped: tuple[str, Path]) -> None:
    attributes, files = read(shipped[1])
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    licence = (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert attributes["version"] == project["version"]
    assert attributes["license"] == project["license"]
    assert attributes["copyright"] in licence
    assert attributes["copyright"].endswith(attributes["author"])
    assert attributes["generationTool"].startswith(f"Perilune {project['version']}")
    assert datetime.fromisoformat(attributes["generationDateAndTime"]) == RELEASED
    assert files["documentation/licenses/perilune.txt"].decode() == licence
    assert validate_fmu(str(shipped[1])) == []


def test_licences_are_listed_and_an_icon_is_there(shipped: tuple[str, Path]) -> None:
    form, path = shipped
    _, files = read(path)
    folder = "documentation/licenses/"
    others = {name.removeprefix(folder) for name in files if name.startswith(folder)} - {"license.txt"}
    entry = files[f"{folder}license.txt"].decode()
    assert others == {line.split()[0] for line in entry.splitlines() if ".txt" in line}
    assert others == {"perilune.txt", "fmi_headers.txt"} | ({"pythonfmu.txt"} if form == "python" else set())
    header = b"Redistribution and use in source and binary forms"
    assert header in files[f"{folder}fmi_headers.txt"]
    assert b"2-Clause BSD License" in files[f"{folder}fmi_headers.txt"]
    assert files["terminalsAndIcons/icon.png" if form == "fmi3" else "model.png"].startswith(PNG)


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_users_block_is_not_said_to_be_ours(fmi: int, tmp_path: Path) -> None:
    attributes, files = read(build(Ours, tmp_path, fmi))
    assert not {"version", "author", "copyright", "license"} & set(attributes)
    assert b"which is its author's" in files["documentation/licenses/license.txt"]


def test_the_date_is_that_of_source_date_epoch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    usual, _ = read(build(Ours, tmp_path / "usual"))
    guid = native_guid(Ours)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1234567890")
    for path in (build(Ours, tmp_path / "native"), build_python_fmu(catalogue()[NAME], tmp_path / "python.fmu")):
        assert read(path)[0]["generationDateAndTime"] == "2009-02-13T23:31:30Z"
    dated, _ = read(tmp_path / "native" / "ours.fmu")
    assert dated["guid"] == usual["guid"] == guid == native_guid(Ours)


def test_a_date_that_is_none_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    with pytest.raises(InputError, match="SOURCE_DATE_EPOCH: yesterday: is not a time; give whole seconds since 1970"):
        build(Ours, tmp_path)


@pytest.mark.usefixtures("fmus")
def test_a_shipped_system_says_where_it_is_from_and_a_users_does_not(tmp_path: Path) -> None:
    shutil.copytree(SYSTEMS / "lunar_descent_2d", tmp_path / "mine")
    ours, files = read(build_one(tmp_path / "ours.fmu", "lunar_descent_2d"))
    users, _ = read(build_one(tmp_path / "users.fmu", tmp_path / "mine"))
    assert ours["author"] == "The Perilune authors"
    assert "author" not in users
    assert files["model.png"].startswith(PNG)
    assert "documentation/licenses/license.txt" in files
    assert validate_fmu(str(tmp_path / "ours.fmu")) == []
