"""The page of a run needs no matplotlib.

Truth: the page that a process writes in which it can be imported.
"""

import subprocess
import sys

import pytest

SYSTEM = "orbital_attitude"
REFUSE = """
import sys

class Refuse:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == "matplotlib":
            raise ImportError(name)

sys.meta_path.insert(0, Refuse())
"""
RUN = "from perilune.analysis.cli import run; run()"


@pytest.mark.usefixtures("fmus")
def test_a_page_is_the_same_without_matplotlib(tmp_path):
    pages = []
    for name, before in (("with", "import matplotlib.pyplot\n"), ("without", REFUSE)):
        page = tmp_path / name / "page.html"
        command = [sys.executable, "-c", before + RUN, "run", SYSTEM, "--stop-time", "60", "--report", str(page)]
        finished = subprocess.run(command, capture_output=True, text=True, check=False)
        assert finished.returncode == 0, finished.stderr
        pages.append(page.read_bytes())
    assert pages[0] == pages[1]
    assert b"<h2>System-specific plots" in pages[0]
