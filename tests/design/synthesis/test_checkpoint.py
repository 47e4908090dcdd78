"""Checkpoints: an interrupted search continues to exactly the same result.

Truth: the same search without interruption, compared in its complete state, to the last bit.
"""

import json
from pathlib import Path

import pytest

from perilune.analysis.design.synthesis.checkpoint import read_checkpoint, state_document, state_of, write_checkpoint
from perilune.analysis.design.synthesis.genetic import Search
from perilune.common.atomic import write_atomically
from perilune.common.errors import InputError
from tests.design.synthesis.test_genetic import SMALL, search
from tests.support.laws.regression import FormulaEvaluator, near

FACTS = {"seed": 3, "fmus": {"plant": "abc"}, "step": 0.1}


def resumed(state):
    return Search(SMALL, FormulaEvaluator(near), state)


def test_resuming_after_every_generation_changes_nothing(tmp_path):
    """Two renewals of the basis lie in between."""
    whole, parts = search(3), search(3)
    path = tmp_path / "checkpoint.json"
    while not whole.is_over:
        whole.advance()
        parts.advance()
        write_checkpoint(path, parts.state, FACTS)
        parts = resumed(read_checkpoint(path, FACTS))
        assert state_document(parts.state) == state_document(whole.state)
    assert parts.choose() == whole.choose()
    assert len(whole.state.bases) == 3


def test_infinite_objectives_survive():
    actual = search(1)
    actual.advance()
    first = actual.state.population[0]
    key, evaluation = first.key, first.evaluation._replace(objectives=(float("inf"), 1.0))
    actual.state.known[key] = evaluation
    actual.state.population[0] = first._replace(evaluation=evaluation)
    text = json.dumps(state_document(actual.state), allow_nan=False)
    assert state_of(json.loads(text)).population[0].evaluation == evaluation


@pytest.mark.parametrize(
    ("facts", "element"),
    [({**FACTS, "seed": 4}, "seed"), ({**FACTS, "fmus": {"plant": "abd"}}, "fmus"), ({**FACTS, "more": 1}, "more")],
)
def test_a_search_that_began_otherwise_is_refused(tmp_path, facts, element):
    path = tmp_path / "checkpoint.json"
    write_checkpoint(path, search(1).state, FACTS)
    with pytest.raises(
        InputError, match=f"checkpoint.json: {element}: differs from its value at the start of the search"
    ):
        read_checkpoint(path, facts)


def test_damaged_checkpoints_are_refused(tmp_path):
    actual = search(1)
    actual.advance()
    path = tmp_path / "checkpoint.json"
    write_checkpoint(path, actual.state, FACTS)
    whole = json.loads(path.read_text())
    broken = [b"", b"{", b"[]", b"\xff", json.dumps({**whole, "version": 2}).encode()]
    for key in whole["state"]:
        broken.append(json.dumps({**whole, "state": {k: v for k, v in whole["state"].items() if k != key}}).encode())
    broken.append(json.dumps({**whole, "state": {**whole["state"], "known": {}}}).encode())
    broken.append(json.dumps({**whole, "state": {**whole["state"], "random": {"bit_generator": "MT19937"}}}).encode())
    for content in broken:
        path.write_bytes(content)
        with pytest.raises(InputError) as caught:
            read_checkpoint(path, FACTS)
        assert "\n" not in str(caught.value)
        assert str(caught.value).startswith(str(path))
    path.unlink()
    with pytest.raises(InputError, match="not found; leave out resume"):
        read_checkpoint(path, FACTS)


def test_a_write_that_fails_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "file"
    write_atomically(path, b"old")

    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(KeyboardInterrupt):
        write_atomically(path, b"new")
    assert path.read_bytes() == b"old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["file"]
