"""Pages of runs, campaigns and comparisons do not require matplotlib.

Truth: the page written by a process in which matplotlib can be imported.
"""

import subprocess
import sys

import pytest

from perilune.analysis.cli import main
from tests.support.lengths import either
from tests.support.pages.comparison_samples import write_sample

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


PAGES = [
    (["run", SYSTEM, "--stop-time", "60"], b'id="section-orbital-attitude"'),
    (["batch", "lunar_terminal_guidance", "--campaign", "paper", "--trials", "4"], b'id="section-failure-region"'),
]


def both(arguments, folder):
    """Return the bytes of a page that this process writes, and those of a process without matplotlib."""
    page, other = folder / "page.html", folder / "without.html"
    assert main([*arguments, "--report", str(page)]) in (0, 1)  # 1: a trial failed
    command = [sys.executable, "-c", REFUSE + RUN, *arguments, "--report", str(other)]
    finished = subprocess.run(command, capture_output=True, text=True, check=False)
    assert finished.returncode in (0, 1), finished.stderr
    return page.read_bytes().replace(page.name.encode(), other.name.encode()), other.read_bytes()


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize(
    ("arguments", "heading"), PAGES[: either(2, 1)], ids=[arguments[0] for arguments, _ in PAGES[: either(2, 1)]]
)
def test_a_page_is_the_same_without_matplotlib(tmp_path, arguments, heading):
    page, other = both(arguments, tmp_path)
    assert page == other
    assert heading in page


def test_a_comparison_is_the_same_without_matplotlib(tmp_path):
    write_sample(tmp_path / "out")
    page, other = both(["compare", str(tmp_path / "out")], tmp_path)
    assert page == other
    assert b'id="section-trajectories"' in page
