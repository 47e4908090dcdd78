"""Files of the cache: damaged files are rewritten, and an unusable cache is ignored, each with one line.

Truth: the written content, and the existing files.
"""

import errno
import hashlib
import os
import warnings

import pytest

from perilune.common.machine import cached

CONTENT = b"what takes a minute to make"


@pytest.fixture
def said(monkeypatch):
    """Return the warnings, each in a line."""
    monkeypatch.setattr(cached, "_warned", set())
    monkeypatch.setattr(cached, "_substitutes", {})
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield lambda: [str(each.message) for each in caught]


def never():
    raise AssertionError("made again")


def test_a_file_is_made_once(tmp_path, said):
    path = tmp_path / "new" / "a.so"
    assert cached.cached_file(path, lambda: CONTENT) == path
    assert cached.cached_file(path, never).read_bytes() == CONTENT
    assert path.with_suffix(".sha256").read_text() == hashlib.sha256(CONTENT).hexdigest()
    assert said() == []


@pytest.mark.parametrize("name", ["a.so", "a.sha256"])
@pytest.mark.parametrize("damaged", [b"", CONTENT[:9], b"\xff\xfe", CONTENT[:-1] + b"!"])
def test_a_damaged_one_is_replaced(tmp_path, said, name, damaged):
    path = cached.cached_file(tmp_path / "a.so", lambda: CONTENT)
    for _ in range(2):
        (tmp_path / name).write_bytes(damaged)
        assert cached.cached_file(path, lambda: CONTENT).read_bytes() == CONTENT
    assert cached.cached_file(path, never) == path
    assert said() == [f"cache {tmp_path}: damaged files, such as a.so, are written again"]


def test_one_whose_checksum_is_missing_is_made_again(tmp_path, said):
    """The process that wrote it was killed, or it is of an earlier version."""
    (tmp_path / "a.so").write_bytes(CONTENT[:9])
    assert cached.cached_file(tmp_path / "a.so", lambda: CONTENT).read_bytes() == CONTENT
    assert said() == []


def denied(number):
    def write(path, *_):
        raise OSError(number, os.strerror(number), str(path))

    return write


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (errno.ENOSPC, "No space left on device: the cache is not used; free some space"),
        (errno.EACCES, "Permission denied: the cache is not used; change its permissions"),
        (errno.EROFS, "Read-only file system: the cache is not used; mount its file system writable"),
    ],
)
def test_a_cache_that_cannot_be_written_is_done_without(tmp_path, said, monkeypatch, number, text):
    monkeypatch.setattr(cached, "write_atomically", denied(number))
    files = [cached.cached_file(tmp_path / name, lambda: CONTENT) for name in ("a.so", "b.so")]
    assert [file.read_bytes() for file in files] == [CONTENT] * 2
    assert cached.cached_file(tmp_path / "a.so", never) == files[0]
    assert list(tmp_path.iterdir()) == []
    assert said() == [f"cache {tmp_path}: {text}"]


def test_a_cache_that_is_a_file(tmp_path, said):
    (tmp_path / "cache").write_text("")
    folder = tmp_path / "cache" / "fused"
    assert cached.cached_file(folder / "a.so", lambda: CONTENT).read_bytes() == CONTENT
    assert said() == [
        f"cache {folder}: Not a directory: the cache is not used; remove the file in the place of the folder"
    ]


def test_a_cache_that_may_not_be_entered(tmp_path, said, monkeypatch):
    """Its files cannot even be looked for, as in a folder of mode 000."""
    for name in ("read_bytes", "mkdir", "unlink"):
        monkeypatch.setattr(cached.Path, name, denied(errno.EACCES))
    monkeypatch.setattr(cached, "write_atomically", denied(errno.EACCES))
    substitute = cached.cached_file(tmp_path / "a.so", lambda: CONTENT)
    monkeypatch.undo()
    assert substitute.read_bytes() == CONTENT
    assert len(said()) == 1
