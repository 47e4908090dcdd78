"""`make check`: tests selected for a change in a folder.

Truth: imports read by hand, and the definition of the selection.
"""

from __future__ import annotations

import subprocess
import sys

from hypothesis import given
from hypothesis import strategies as st

from tests.times.check import ROOT, importers_of, select
from tests.times.check import tests_of as files_of

TIMES = st.dictionaries(st.sampled_from("abcdefgh"), st.floats(0.1, 100.0), min_size=1)


@given(TIMES, st.floats(0.0, 300.0))
def test_files_fill_the_budget_and_the_dearest_is_last(times, budget):
    first, second = sorted(times)[::2], sorted(times)[1::2]
    chosen, left = select([first, second], times, budget)
    assert sorted(chosen + left) == sorted(times)
    assert sum(times[each] for each in chosen) <= budget + 1e-9
    for group in (first, second):
        costs = [times[each] for each in chosen if each in group]
        assert costs == sorted(costs)
    if left:
        assert sum(times[each] for each in chosen) + min(times[each] for each in left) > budget - 1e-9


def test_importers_are_folders_whose_files_import_the_room():
    assert "analysis/verbs" in importers_of("analysis/show")
    assert "analysis/show" not in importers_of("analysis/show")


def test_files_lie_where_the_room_does():
    assert "tests/mathlib/test_rng.py" in files_of(["fmus_src/mathlib"], inside=True)
    assert "tests/blocks/sensors/test_lunar_sensors.py" in files_of(["fmus_src/sensors"], inside=True)
    assert files_of(["analysis/show"], inside=False) == sorted(
        path.relative_to(ROOT).as_posix() for path in (ROOT / "tests" / "show").glob("test_*.py")
    )


def test_no_room_is_one_line():
    done = subprocess.run(
        [sys.executable, "-m", "tests.times.check", "analysis/nowhere"], cwd=ROOT, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
