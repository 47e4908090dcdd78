"""Users' files with the names of the product's folders, and a folder with the name of the clone: no confusion.

Truth: the script runs, and imports by these names are its own files.
"""

from __future__ import annotations

import subprocess
import sys

import pytest

from perilune.common.paths import ROOT
from tests.support.lengths import LONG

SCRIPT = """
import analysis, common, tests, fmus_src
assert analysis.MINE == common.MINE == tests.MINE == fmus_src.MINE == 1
import perilune
assert perilune.simulate("lunar_terminal_guidance", flavour="python", stop_time=1.0).complete
"""
WORKERS = """
result = perilune.batch("lunar_terminal_guidance", "paper", trials=2, workers=2, flavour="python")
assert not any(trials.messages for trials in result.trials.values())
"""  # in processes, which import anew


@pytest.fixture
def folder(tmp_path):
    """Return a folder with the clone in it, named as git names it, and a user's files next to it."""
    (tmp_path / "perilune").symlink_to(ROOT)
    for name in ("analysis", "common", "tests", "fmus_src"):
        (tmp_path / f"{name}.py").write_text("MINE = 1\n")
    (tmp_path / "script.py").write_text(SCRIPT + (WORKERS if LONG else ""))
    return tmp_path


@pytest.mark.usefixtures("fmus")
def test_from_the_checkout(folder):
    done = subprocess.run([sys.executable, "script.py"], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_from_the_wheel(installed, folder):
    done = installed.run("script.py", cwd=folder, script=True)
    assert done.returncode == 0, done.stderr
