"""Library of the loop: its sources, the choice of the loaded library, and the message without a library."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import NamedTuple

import numpy as np
import pytest

from perilune.analysis.runtime.loop import codes, library, structures
from perilune.analysis.runtime.loop.library import build_loop, built_file, load_library
from perilune.common.errors import InputError
from perilune.fmus_src.export.compilers import local_platform

RUN = "import perilune; print(perilune.simulate('satellite_pointing', stop_time=1.0).status)"


class Settings(NamedTuple):
    real: np.ndarray
    whole: np.ndarray
    text: np.ndarray


@pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 has no name for this platform")
def test_the_file_is_named_by_its_content(tmp_path, monkeypatch):
    """A change of a source, or of a compiler's option, gives another name, and the old file is gone."""
    platform = local_platform(3)
    build_loop(tmp_path, [platform])
    first = built_file(tmp_path, platform)
    assert [file.name for file in first.parent.iterdir()] == [first.name]
    before = first.stat().st_mtime_ns
    build_loop(tmp_path, [platform])
    assert first.stat().st_mtime_ns == before
    monkeypatch.setattr(library, "FLAGS", (*library.FLAGS, "-DANOTHER"))
    library._digest.cache_clear()
    try:
        build_loop(tmp_path, [platform])
        second = built_file(tmp_path, platform)
        assert [file.name for file in first.parent.iterdir()] == [second.name] != [first.name]
    finally:
        library._digest.cache_clear()


def test_python_and_c_declare_the_same():
    load_library()
    numbers = structures.enumerators("codes.h") | structures.enumerators("run.h")
    assert len(numbers) > 70
    constants = {name for name in vars(codes) if name.isupper()}
    assert constants - numbers.keys() == {"IN_MEMORY", "READ_REAL"}


def test_codes_that_differ_are_refused(monkeypatch):
    monkeypatch.setattr(codes, "STEP", 99)
    with pytest.raises(ImportError, match=r"codes\.py or structures\.py and c differ: STEP"):
        library._check(load_library())


@pytest.mark.parametrize(
    "whole", [np.zeros(4), np.zeros(8, dtype=np.int32)[::2]], ids=["another type", "elements apart"]
)
def test_an_array_that_c_would_misread_is_refused(whole):
    settings = structures.FilledStructure("Settings")
    with pytest.raises(TypeError, match=r"\.whole: an array of .* where the loop reads int32"):
        settings.fill(Settings(np.zeros(4), whole, np.zeros(4, dtype=np.uint64)))


def test_arrays_live_as_long_as_the_structure():
    settings = structures.FilledStructure("Settings")
    settings.fill(Settings(np.arange(4.0), np.zeros(4, dtype=np.int32), np.zeros(4, dtype=np.uint64)))
    real = np.ctypeslib.as_array((np.ctypeslib.ctypes.c_double * 4).from_address(settings.memory.real))
    assert real.tolist() == [0.0, 1.0, 2.0, 3.0]


def test_without_a_library_and_a_compiler(tmp_path, monkeypatch):
    monkeypatch.setattr(library, "BUILD", tmp_path)
    monkeypatch.setattr(library, "compilers_for", _no_compiler)
    with pytest.raises(
        InputError, match=r"is not built, and no C compiler is installed; install cc, or pip install zigl"
    ):
        library.load_library.__wrapped__()


def _no_compiler(_platform):
    raise library.CompilerMissing


def test_a_library_that_is_none(tmp_path, monkeypatch):
    monkeypatch.setattr(library, "BUILD", tmp_path)
    file = built_file(tmp_path, local_platform(3) or "")
    file.parent.mkdir(parents=True)
    file.write_bytes(b"no library")
    with pytest.raises(InputError, match=r"is not a library: .*; build or install Perilune again"):
        library.load_library.__wrapped__()


@pytest.mark.usefixtures("fmus")
def test_a_run_writes_no_cache(tmp_path):
    """A build has the library: nothing is compiled at the first use."""
    environment = os.environ | {"XDG_CACHE_HOME": str(tmp_path), "PATH": ""}
    command = [sys.executable, "-c", RUN]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "stop_time"
    assert list(tmp_path.iterdir()) == []
