"""From a system's folder to its .ssp: place of every file, FMUs named by its SSDs, reproducible bytes.

Truth: the layout of SSP 1.0; zipfile; the files of the folder.
"""

import zipfile

import pytest

from perilune.common.paths import BUILD, SYSTEMS
from perilune.fmus_src.export.ssp_package import pack_system, system_files
from tests.support.builders import component, document, fly, parameter_set, system


@pytest.fixture
def folder(tmp_path):
    root = tmp_path / "two_ramps"
    for name, text in {
        "SystemStructure.ssd": document(system(component("a", "ramp", "output y Real m"))),
        "second.ssd": document(system(component("a", "gain"))),
        "set.ssv": parameter_set("a.start=Real:3"),
        "map.ssm": "<x/>",
        "bus.ssb": "<x/>",
        "README.md": "read",
        "notes.txt": "left out",
        ".hidden": "left out",
        "campaigns/one.toml": "x = 1",
        "resources/data.csv": "1,2",
        "documentation/index.html": "<p/>",
        "extra/org.other/file": "x",
    }.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    return root


EXPECTED = {
    "SystemStructure.ssd",
    "second.ssd",
    "resources/set.ssv",
    "resources/map.ssm",
    "resources/bus.ssb",
    "documentation/README.md",
    "extra/org.perilune/campaigns/one.toml",
    "resources/data.csv",
    "documentation/index.html",
    "extra/org.other/file",
}


def test_every_file_has_its_place(folder):
    assert set(system_files(folder)) == EXPECTED


def test_packed_with_the_fmus_that_any_ssd_names(folder, tiny, tmp_path):
    path = pack_system(folder, [tiny], tmp_path / "out")
    assert path.name == "two_ramps.ssp"
    with zipfile.ZipFile(path) as archive:
        assert set(archive.namelist()) == EXPECTED | {"resources/ramp.fmu", "resources/gain.fmu"}
        assert archive.read("resources/ramp.fmu") == (tiny / "ramp.fmu").read_bytes()
        assert {entry.compress_type for entry in archive.infolist()} <= {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}
    assert fly(path, parameters=("set.ssv",))["a.y"][0] == 3.0
    assert fly(path, variant="second", set={"a.u": 1.0})["a.y"][0] == 3.0


def test_two_packings_are_the_same_bytes(folder, tiny, tmp_path):
    first, second = (pack_system(folder, [tiny], tmp_path / name) for name in ("a", "b"))
    assert first.read_bytes() == second.read_bytes()


def test_an_fmu_that_is_missing_is_named(folder, tmp_path):
    with pytest.raises(ValueError, match=r"SystemStructure\.ssd: resources/ramp\.fmu.*no"):
        pack_system(folder, [tmp_path], tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("fmus")
def test_our_systems_are_packed_as_built():
    for path in SYSTEMS.glob("*/system.toml"):
        with zipfile.ZipFile(BUILD / "ssp" / f"{path.parent.name}.ssp") as archive:
            names = set(archive.namelist())
            assert set(system_files(path.parent)) <= names
            assert archive.read("SystemStructure.ssd") == path.with_name("SystemStructure.ssd").read_bytes()
            assert any(name.endswith(".fmu") for name in names)
