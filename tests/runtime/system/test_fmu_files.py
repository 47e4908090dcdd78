"""Unpacked files of an FMU, and sharing of these files when it is loaded again.

Truth: the archive of the FMU.
"""

import errno
import hashlib
import zipfile

import fmpy
import pytest

from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.common.errors import InputError
from perilune.common.paths import shipped_fmu
from perilune.fmus_src.own_digests import SUMS, note_own
from tests.support.builders import retouched, write_zip
from tests.support.lengths import either


def contents(path):
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def unpacked(fmu):
    files = (path for path in fmu.folder.rglob("*") if path.is_file())
    return {path.relative_to(fmu.folder).as_posix(): path.read_bytes() for path in files}


def load(path):
    return load_fmu(path.read_bytes(), path.name)


@pytest.fixture
def large(tiny, tmp_path):
    """Write the ramp with files for another platform, sources, documents, and files for no purpose that FMI knows."""
    more = ("binaries/win32/ramp.dll", "binaries/common.txt", "sources/ramp.c", "documentation/index.html", "extra/x")
    files = contents(tiny / "ramp.fmu") | {name: name.encode() for name in (*more, "resources/deep/table.csv")}
    path = write_zip(tmp_path / "large.fmu", files)
    note_own(path)
    return path


def test_of_our_own_what_a_flight_here_reads(large):
    retained = ("modelDescription.xml", f"binaries/{fmpy.platform}/", "resources/")
    expected = {name: content for name, content in contents(large).items() if name.startswith(retained)}
    assert "resources/deep/table.csv" in expected
    assert f"binaries/{fmpy.platform}/ramp{fmpy.sharedLibraryExtension}" in expected
    assert unpacked(load(large)) == expected


def test_of_others_everything(large, tmp_path):
    """Whatever it says of itself: the same with another description, still of our generationTool."""
    foreign = retouched(large, tmp_path / "foreign.fmu", lambda text: text.replace("description=", " description="))
    fmu = load(foreign)
    assert fmu.description.generationTool.startswith("Perilune ")
    assert not fmu.is_own
    assert unpacked(fmu) == contents(foreign)


@pytest.mark.parametrize("flavour", ["native", "python"])
def test_what_was_built_is_our_own(flavour):
    """The list next to the built FMUs is what sha256sum writes."""
    folder = shipped_fmu("", flavour).parent
    listed = dict(reversed(line.split("  ")) for line in (folder / SUMS).read_text().splitlines())
    for path in sorted(folder.glob("*.fmu")):
        assert listed[path.name] == hashlib.sha256(path.read_bytes()).hexdigest()
    for path in sorted(folder.glob("*.fmu"))[:: either(1, 10)]:
        assert load(path).is_own


def test_a_second_one_has_a_folder_of_its_own(tiny):
    first, second = load(tiny / "ramp.fmu"), load(tiny / "ramp.fmu")
    assert first.folder != second.folder
    assert unpacked(first) == unpacked(second)
    assert list(first.variables) == list(second.variables)


def test_flaws_are_told_each_time(tiny, tmp_path):
    flawed = retouched(
        tiny / "ramp.fmu", tmp_path / "flawed.fmu", lambda text: text.replace("<ModelVar", "<Odd/><ModelVar")
    )
    first, second = load(flawed), load(flawed)
    assert first.flaws == second.flaws != []
    first.flaws.clear()
    assert load(flawed).flaws == second.flaws
    with pytest.raises(InputError, match=r"again: modelDescription.xml: not valid: .*Odd.*; fix the FMU"):
        load_fmu(flawed.read_bytes(), "again", strict=True)


def test_a_full_disk_names_the_folder(tiny, monkeypatch):
    """Not the archive, which is whole."""

    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(zipfile.ZipFile, "extractall", full)
    with pytest.raises(InputError, match=r"cannot be unpacked to /.*: No space left on device; free some space"):
        load(tiny / "ramp.fmu")
