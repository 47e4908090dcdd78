"""Symbolic links in archives, as packed by `zip -y`: named, and not followed. Truth: the archives written here."""

import zipfile

import pytest

import perilune
from tests.support.builders import document, system, write_zip
from tests.support.foreign.odd_fmu import odd_fmu


@pytest.mark.parametrize("name", ["binaries", "documentation/index.html"])
def test_a_link_in_an_fmu_is_named(tmp_path, name):
    path = odd_fmu(tmp_path)
    add_link(path, name)
    with pytest.raises(perilune.InputError) as refused:
        perilune.simulate(path)
    assert str(refused.value) == f"{path}: {name}: {LINK}"


def test_a_link_in_a_system_is_named(tmp_path):
    path = write_zip(tmp_path / "s.ssp", {"SystemStructure.ssd": document(system())})
    add_link(path, "resources")
    with pytest.raises(perilune.InputError) as refused:
        perilune.simulate(path)
    assert str(refused.value) == f"{path}: resources: {LINK}"


LINK = (
    "is a symbolic link, which is not accepted in an archive; "
    "repack the archive with the file or folder in place of the link"
)


def add_link(path, name):
    entry = zipfile.ZipInfo(name)
    entry.external_attr = 0o120777 << 16
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(entry, "elsewhere")
