"""Windows by Wine, for programs built by a test; `make windows` installs it."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

WINE = shutil.which("wine")


@contextmanager
def fresh_windows() -> Iterator[dict[str, str]]:
    """Yield an environment whose Wine has a fresh Windows, of 700 MB, which ends with the context."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as prefix:
        environment = {**os.environ, "WINEPREFIX": prefix, "WINEDEBUG": "-all"}
        subprocess.run([str(WINE), "wineboot", "--init"], env=environment, check=True, capture_output=True)
        yield environment
        subprocess.run([str(WINE), "wineboot", "--kill"], env=environment, check=True, capture_output=True)
