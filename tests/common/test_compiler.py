"""Where the compiled loop is kept: in the cache folder, never beside the source.

Truth: the folders before and after; a folder that cannot be.
"""

import errno
import itertools
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from numba import config

from perilune.analysis.common import compiler
from perilune.analysis.common.machine import cached
from perilune.analysis.runtime.flight.compiled.loop import function
from perilune.fmus_src.paths import CACHE


def doubled(x):
    return 2 * x


def test_the_loop_is_kept_in_the_cache_folder():
    for locked, fmi3, fused in itertools.product((False, True), repeat=3):
        loop = function(locked=locked, with_fmi3=fmi3, with_fused=fused)
        assert Path(loop.stats.cache_path).is_relative_to(config.CACHE_DIR or CACHE / "numba")


def test_a_function_is_kept_and_found_again(tmp_path, monkeypatch):
    monkeypatch.setattr(compiler, "CACHE", tmp_path)
    monkeypatch.setattr(config, "CACHE_DIR", "")
    assert compiler.compile_cached(doubled)(21) == 42
    assert list((tmp_path / "numba").rglob("*doubled*.nbc"))
    assert config.CACHE_DIR == ""
    repeated = compiler.compile_cached(doubled)
    assert repeated(21) == 42
    assert sum(repeated.stats.cache_hits.values()) == 1


def test_the_folder_that_numba_is_told_of_wins(tmp_path, monkeypatch):
    monkeypatch.setattr(compiler, "CACHE", tmp_path / "ours")
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path / "theirs"))
    assert compiler.compile_cached(doubled)(21) == 42
    assert [path.name for path in tmp_path.iterdir()] == ["theirs"]


def test_threads_keep_functions_in_the_folders_of_their_rooms(tmp_path, monkeypatch):
    monkeypatch.setattr(compiler, "CACHE", tmp_path)
    monkeypatch.setattr(config, "CACHE_DIR", "")

    def compile_slowly(**options):
        def folders_of(function):
            before = config.CACHE_DIR
            time.sleep(0.005)  # another thread's turn
            return before, config.CACHE_DIR

        return folders_of

    functions = [doubled, function(locked=True, with_fmi3=False, with_fused=False).py_func] * 20
    with ThreadPoolExecutor(8) as threads:
        folders = list(threads.map(lambda function: compiler.compile_cached(function, compile_slowly), functions))
    assert all(before == after for before, after in folders)
    here, loop = set(folders[::2]), set(folders[1::2])
    assert len(here) == len(loop) == 1
    assert here != loop
    assert config.CACHE_DIR == ""


def test_a_folder_that_cannot_be_written_is_said(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(compiler, "CACHE", tmp_path / "file")
    monkeypatch.setattr(config, "CACHE_DIR", "")
    with pytest.warns(UserWarning, match="Not a directory: done without; remove the file"):
        function = compiler.compile_cached(doubled)
    assert function(21) == 42
    assert not list(Path(__file__).parent.rglob("*doubled*.nb*"))


@pytest.mark.parametrize("setting", ["", "theirs"])
@pytest.mark.parametrize("suffix", [".nbi", ".nbc"])
def test_damaged_files_are_compiled_again_and_replaced(tmp_path, monkeypatch, suffix, setting):
    """Empty, cut, of other bytes, and with one changed bit, which numba would run."""
    monkeypatch.setattr(compiler, "CACHE", tmp_path)
    monkeypatch.setattr(config, "CACHE_DIR", setting and str(tmp_path / setting))
    assert compiler.compile_cached(doubled)(21) == 42
    (file,) = tmp_path.rglob(f"*doubled*{suffix}")
    whole = file.read_bytes()
    for damaged in (b"", whole[: len(whole) // 2], b"garbage" * 99, whole[:99] + bytes([whole[99] ^ 1]) + whole[100:]):
        file.write_bytes(damaged)
        monkeypatch.setattr(cached, "_warned", set())
        function = compiler.compile_cached(doubled)
        with pytest.warns(UserWarning, match="damaged files are made again, .*doubled"):
            assert function(21) == 42
        assert not function.stats.cache_hits
        repeated = compiler.compile_cached(doubled)
        assert repeated(21) == 42
        assert sum(repeated.stats.cache_hits.values()) == 1


def test_a_disk_that_fills_up_ends_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(compiler, "CACHE", tmp_path)
    monkeypatch.setattr(config, "CACHE_DIR", "")

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(compiler, "write_sealed", full)
    function = compiler.compile_cached(doubled)
    with pytest.warns(UserWarning, match=f"cache {tmp_path}.*: No space left on device: done without; free some space"):
        assert function(21) == 42
