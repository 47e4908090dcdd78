"""Crossed connections of elements of vectors: a note of `validate`.

Truth: the indices of each system, written here.
"""

from __future__ import annotations

import re

import pytest

import perilune
from perilune.analysis.runtime.ssp.archive import system_names
from tests.support.builders import component, connection, document, system, write_zip


def notes(tmp_path, tiny, pairs):
    """Return notes on a system in which output u[i] of one component is connected with input v[j] of another."""
    wires = "".join(connection(f"a.y[{i}]", f"b.u[{j}]") for i, j in pairs)
    outputs = "; ".join(f"output y[{i}] Real" for i in (1, 2, 3))
    inputs = "; ".join(f"input u[{j}] Real" for j in (1, 2, 3))
    ssd = document(system(component("a", "three", outputs), component("b", "three", inputs), connections=wires))
    files = {"SystemStructure.ssd": ssd, "resources/three.fmu": (tiny / "three.fmu").read_bytes()}
    (check,) = perilune.validate(write_zip(tmp_path / "s.ssp", files), open_inputs="start")
    assert check.problems == ()
    return [note for note in check.notes if "connects elements of different indices" in note]


@pytest.fixture(scope="module")
def three(tmp_path_factory):
    """Build an FMU with an input and an output of three elements."""
    folder = tmp_path_factory.mktemp("three")
    (folder / "three.py").write_text(THREE)
    perilune.export(folder / "three.py", flavour="python", output=folder / "three.fmu")
    return folder


THREE = """
from perilune import Block, Input, Output


class Three(Block):
    \"\"\"Three outputs.\"\"\"

    u = Input([0.0, 0.0, 0.0], description="u")
    y = Output([1.0, 2.0, 3.0], description="y")

    def step(self, t: float, h: float) -> None:
        self.y[1] = 2.0
"""


@pytest.mark.parametrize(
    ("pairs", "crosswise"),
    [
        ([(2, 1), (1, 2), (3, 3)], ["a.y[2] -> b.u[1]", "a.y[1] -> b.u[2]"]),
        ([(2, 1), (2, 2), (3, 3)], ["a.y[2] -> b.u[1]"]),
        ([(1, 1), (2, 2), (3, 3)], []),
        ([(2, 1), (3, 2), (1, 3)], []),  # a rotation
        ([(1, 1), (3, 2)], []),  # picked in order
        ([(1, 1), (1, 2), (1, 3)], []),  # one for all
    ],
)
def test_elements_that_go_crosswise_are_noted(tmp_path, three, pairs, crosswise):
    actual = notes(tmp_path, three, pairs)
    assert [note.partition("connection ")[2].partition(" (")[0] for note in actual] == crosswise
    assert all(re.search(r"while a.y\[(\d)\] -> b.u\[\1\] connects equal indices", note) for note in actual)


@pytest.mark.usefixtures("fmus")
def test_no_shipped_system_goes_crosswise():
    for check in perilune.validate(*system_names()):
        assert not [note for note in check.notes if "connects elements of different indices" in note]
