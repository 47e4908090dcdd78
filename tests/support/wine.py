"""Windows by Wine, for programs that a test has built: installed by `make windows`."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator

import pytest

WINE = shutil.which("wine")


@pytest.fixture(scope="module")
def windows() -> Iterator[dict[str, str]]:
    """An environment whose Wine has a fresh Windows, of 700 MB, which ends with the tests."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as prefix:
        environment = {**os.environ, "WINEPREFIX": prefix, "WINEDEBUG": "-all"}
        subprocess.run([str(WINE), "wineboot", "--init"], env=environment, check=True, capture_output=True)
        yield environment
        subprocess.run([str(WINE), "wineboot", "--kill"], env=environment, check=True, capture_output=True)
