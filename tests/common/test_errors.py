"""perilune.common.errors: messages of one line, suggestions of names, warnings. Truth: the texts, written here."""

import pickle
import warnings

import pytest

from perilune.common.errors import InputError, suggestion, warn_in_one_line


def test_is_one_line_with_place_problem_and_remedy():
    error = InputError("a.toml", "draw.x", "not\na number", "write one")
    assert str(error) == "a.toml: draw.x: not a number; write one"
    assert isinstance(error, ValueError)


def test_without_an_element():
    assert str(InputError("a.toml", "", "missing", "give it")) == "a.toml: missing; give it"


def test_survives_pickling_between_processes():
    error = pickle.loads(pickle.dumps(InputError("a.toml", "draw.x", "wrong", "right")))
    assert (error.file, error.element, error.problem, error.remedy) == ("a.toml", "draw.x", "wrong", "right")


def test_suggestion_is_nearest_first_among_many():
    assert suggestion("b", ["a", "c"]) == "use one of a, c"
    many = [f"plant.position[{i}]" for i in range(50)] + ["guidance.status"]
    assert suggestion("guidance.statu", many).split(": ")[1].startswith("guidance.status")
    assert "none is available" in suggestion("x", [])


def test_warnings_are_a_line_without_their_place(monkeypatch):
    monkeypatch.setattr(warnings, "formatwarning", warnings.formatwarning)  # put back in the end
    warn_in_one_line()
    assert warnings.formatwarning("a.fmu: odd", UserWarning, "place.py", 7) == "perilune: a.fmu: odd\n"


def test_suggestions_are_few_nearest_first_and_in_natural_order():
    known = [f"guidance.target_position[{i}]" for i in (10, 3, 1, 2)] + [f"plant.{name}" for name in "abcdefghi"]
    actual = suggestion("guidance.target_position[9]", known)
    assert actual.endswith(": " + ", ".join(f"guidance.target_position[{i}]" for i in (1, 2, 3, 10)))
    few = ["guidance", "plant", "control"]
    assert suggestion("contrl", few) == "use one of control, guidance, plant"
    many = [f"block_{chr(97 + i)}" for i in range(20)]
    assert suggestion("f.html", many) == "use one of block_a, block_b, block_c, block_d and 16 more"


@pytest.mark.parametrize(("problem", "said"), [("ends.", "ends"), ("goes on ...", "goes on ..."), ("ends", "ends")])
def test_a_full_stop_before_the_remedy_is_left_out(problem, said):
    assert str(InputError("f", "e", problem, "mend it")) == f"f: e: {said}; mend it"
