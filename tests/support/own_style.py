"""Style of the Python in a folder, compared with ruff's under the product's settings."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from perilune.common.paths import ROOT


def assert_in_style(folder: Path) -> None:
    for verb in (["format", "--check"], ["check"]):
        command = [Path(sys.executable).with_name("ruff"), *verb, "--no-cache", "--config", ROOT / "pyproject.toml"]
        done = subprocess.run([*command, "."], cwd=folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
