"""Modules under the names of the last release: import with a note on the new name, and packing into FMUs.

Truth: the table of the changelog; the modules under their new names.
"""

from __future__ import annotations

import re
import sys
from importlib import import_module

import pytest

from perilune.common.paths import ROOT
from perilune.fmus_src.former_names import FORMER, PACKAGE

BLOCK = """
from perilune import Block, Output
from perilune.fmus_src.mathlib import gravity
from perilune.fmus_src.mathlib.{module} import {function}


class Mine(Block):
    \"\"\"Imports what has moved.\"\"\"

    y = Output(0.0, description="y")

    def step(self, t: float, h: float) -> None:
        self.y = t + h
"""


@pytest.mark.parametrize("old", FORMER)
def test_the_old_name_is_the_new_module_and_says_so(old):
    new = import_module(f"{PACKAGE}.{FORMER[old]}")
    sys.modules.pop(f"{PACKAGE}.{old}", None)
    with pytest.warns(UserWarning, match=re.escape(f"import {PACKAGE}.{FORMER[old]}")):
        assert import_module(f"{PACKAGE}.{old}") is new


def test_all_moves_of_the_changelog_are_accepted():
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (.*?) \| (.*?) \|$", text, re.MULTILINE)
    first = next(index for index, row in enumerate(rows) if row[0].startswith("modules `perilune.fmus_src.mathlib"))
    last = next(index for index, row in enumerate(rows) if row[0].startswith("`perilune.GOOD`"))
    named = {name for old, _ in rows[first:last] for name in re.findall(r"`(\w+)`", old)}
    assert len(named) > 30
    assert named - {"hover_NAME"} <= {name.rpartition(".")[2] for name in FORMER}


def test_other_names_are_not_found():
    with pytest.raises(ModuleNotFoundError):
        import_module(f"{PACKAGE}.mathlib.gravitation")


@pytest.mark.parametrize("flavour", ["python", "native"])
def test_a_block_that_imports_them_is_exported_and_simulated(tmp_path, monkeypatch, flavour):
    import perilune

    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").write_text(BLOCK.format(module="lagged_thrust", function="__doc__ as text"))
    perilune.export("mine.py", flavour=flavour)
    flight = perilune.simulate(f"build/fmus/{flavour}/mine.fmu", stop_time=1.0, step=0.5)
    assert flight["mine.y"].tolist() == [0.0, 0.5, 1.0]
