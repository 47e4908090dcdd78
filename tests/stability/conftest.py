"""The FMUs of exact_blocks.py, built once per test run."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def exact_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with `python` and `native`."""
    from exact_blocks import build_exact_fmus

    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "exact_fmus"
    with folder.with_name("exact_fmus.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.is_dir():
            partial = folder.with_name("exact_fmus.part")
            build_exact_fmus(partial)
            partial.rename(folder)
    return folder


@pytest.fixture(scope="session")
def exact_fmus(exact_folder: Path) -> Path:
    """The native ones."""
    return exact_folder / "native"
