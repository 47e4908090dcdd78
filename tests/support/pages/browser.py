"""Page in a real browser, headless: its DOM or a picture."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

NO_BROWSER = "no chromium"  # tests/conftest.py tells at the end what was left out for it
FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--window-size=1100,3000",
)  # fmt: skip


def find_browser() -> str:
    """Return the path of chromium; without it tests that need it are skipped, which CI does not allow."""
    collected = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if collected is None and os.environ.get("PERILUNE_REQUIRE_BROWSER") == "1":
        pytest.fail("chromium is not installed, and PERILUNE_REQUIRE_BROWSER=1 asks for it")
    if collected is None:
        pytest.skip(NO_BROWSER)
    return collected


def start(browser: str, page: Path, folder: Path, *arguments: str, fragment: str = "") -> str:
    """Return what the browser prints of a page, with a profile in ``folder``; a ``fragment`` begins with #."""
    command = [browser, *FLAGS, f"--user-data-dir={folder / 'profile'}", *arguments, page.as_uri() + fragment]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=True).stdout
