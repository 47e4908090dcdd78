"""FMUs built by Perilune on this machine: Python FMUs in the cache, and the list that identifies them.

Truth: FMUs built elsewhere, and the format of sha256sum.
"""

import errno
import hashlib
import os
from pathlib import Path

import pytest

from perilune.common.machine import cached
from perilune.fmus_src import own_digests
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export import available
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu

NAME = "forming_filter"
OTHER = "0" * 64


@pytest.fixture
def listed(tmp_path, monkeypatch):
    """Return the list of a machine that has built nothing yet."""
    path = tmp_path / "cache" / own_digests.SUMS
    monkeypatch.setattr(own_digests, "NOTED", path)
    monkeypatch.setattr(own_digests, "LISTS", (path,))
    monkeypatch.setattr(own_digests, "_built_here", set())
    monkeypatch.setattr(cached, "_warned", set())
    monkeypatch.setattr(cached, "_substitutes", {})
    return path


@pytest.fixture
def fmu(tmp_path):
    path = tmp_path / "x.fmu"
    path.write_bytes(os.urandom(99))
    return path


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.fixture
def installed(listed, monkeypatch):
    """Set the paths of an installed package, which has no Python FMUs."""
    monkeypatch.setattr(available, "IS_CHECKOUT", False)
    monkeypatch.setattr(available, "shipped_fmu", lambda name, flavour: Path("nowhere"))
    monkeypatch.setattr(available, "_python_folder", lambda: listed.parent / "fmus")


@pytest.mark.usefixtures("installed")
def test_a_cut_python_fmu_is_built_again(listed, tmp_path):
    whole = build_python_fmu(catalogue()[NAME], tmp_path / "elsewhere.fmu").read_bytes()
    path = available.fmu_file(NAME, "python")
    assert path == listed.parent / "fmus" / f"{NAME}.fmu"
    assert path.read_bytes() == whole
    path.write_bytes(whole[: len(whole) // 2])
    listed.write_bytes(b"\xff\xfe")
    with pytest.warns(UserWarning, match=f"damaged files, such as {NAME}.fmu, are written again"):
        assert available.fmu_file(NAME, "python").read_bytes() == whole
    listed.unlink()
    assert available.fmu_file(NAME, "python") == path
    assert own_digests.is_own(digest(path))


@pytest.mark.usefixtures("installed")
def test_without_a_cache_python_fmus_are_temporary_and_ones_own(listed):
    listed.parent.write_text("a file in place of the folder")
    with pytest.warns(UserWarning, match="Not a directory: the cache is not used"):
        path = available.fmu_file(NAME, "python")
    assert own_digests.is_own(digest(path))
    assert available.fmu_file(NAME, "python") == path


@pytest.mark.parametrize("damage", [b"\xff\xfe\x80\n", b"no digest\n", b"\0" * 99 + b"\n", b"0" * 50])
def test_damaged_lines_of_the_list_are_left_out_and_said(listed, fmu, damage):
    listed.parent.mkdir()
    listed.write_bytes(f"{OTHER}  y.fmu\n".encode() + damage)
    with pytest.warns(UserWarning, match="SHA256SUMS: line 2 not in the format of sha256sum: ignored; remove the file"):
        own_digests.note_own(fmu)
    assert own_digests.is_own(digest(fmu))
    assert own_digests.is_own(OTHER)


def test_names_are_bytes(listed, tmp_path, fmu):
    named = fmu.rename(tmp_path / os.fsdecode(b"n\xff.fmu"))
    own_digests.note_own(named)
    assert own_digests.is_own(digest(named))
    assert listed.read_bytes() == digest(named).encode() + b"  n\xff.fmu\n"


@pytest.mark.parametrize(
    "error", [PermissionError(errno.EACCES, "Permission denied"), OSError(errno.ESTALE, "Stale file handle")]
)
def test_a_list_that_cannot_be_looked_at(listed, fmu, monkeypatch, error):
    def refuse(*_, **__):
        raise error

    for name in ("stat", "mkdir"):
        monkeypatch.setattr(own_digests.Path, name, refuse)
    with pytest.warns(UserWarning, match=f"cache {listed.parent}: {error.strerror}: the cache is not used"):
        own_digests.note_own(fmu)
    assert own_digests.is_own(digest(fmu))


def test_a_list_that_is_a_folder(listed, fmu):
    listed.mkdir(parents=True)
    with pytest.warns(UserWarning, match="SHA256SUMS: a folder, not a regular file; remove it"):
        own_digests.note_own(fmu)
    assert own_digests.is_own(digest(fmu))
