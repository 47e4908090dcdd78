"""Law files: read, checked, written.

Truth: the published matrices entered separately as edges; the documented format; property-based round trips; one line
per error that names the file and the cell.
"""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.design.laws.law import NetworkOperator, find_law, read_law
from perilune.common.errors import InputError
from tests.support.laws.networks import matrices

PAPER = {
    **{(1, 7): 1, (1, 8): 23, (2, 7): 1, (3, 8): 1, (3, 11): 9, (3, 14): 4, (4, 8): 1, (4, 13): 5, (5, 9): 1},
    **{(5, 12): 11, (6, 9): 1, (7, 7): 1, (7, 10): 1, (7, 13): 18, (8, 8): 1, (8, 11): 1, (8, 15): 9, (9, 9): 1},
    **{(9, 12): 3, (10, 10): 1, (10, 15): 5, (11, 13): 6, (11, 14): 1, (12, 12): 1, (12, 13): 6, (12, 14): 18},
    **{(12, 16): 3, (13, 16): 6, (14, 15): 8, (15, 16): 15},
}
BASIC = {
    **{(1, 7): 1, (2, 7): 1, (3, 8): 1, (3, 11): 9, (4, 8): 1, (5, 9): 1, (5, 12): 11, (6, 9): 1, (7, 7): 1},
    **{(7, 10): 1, (8, 8): 1, (8, 11): 1, (9, 9): 1, (9, 12): 3, (10, 15): 1, (11, 11): 1, (11, 14): 1},
    **{(12, 12): 1, (12, 13): 1, (13, 16): 1, (14, 15): 1},
}


@pytest.mark.parametrize(
    ("name", "entries", "q"),
    [("diveev_2013", PAPER, (1.50049, 13.5459, 12.96753)), ("diveev_2013_basic", BASIC, (1.0, 1.0, 1.0))],
)
def test_published_laws(name, entries, q):
    law = read_law(find_law(name))
    actual = np.array(law.matrix)
    assert {(int(i) + 1, int(j) + 1): actual[i, j] for i, j in np.argwhere(actual)} == entries
    assert law.q == q
    assert law.exp_saturation == "legacy"
    assert law.name == name
    assert "Diveev" in law.description


LINE = st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]), min_size=1)
LAWS = st.builds(
    NetworkOperator,
    LINE,
    matrices(),
    st.tuples(*[st.floats(allow_nan=False, allow_infinity=False, max_value=1e308, min_value=-1e308)] * 3),
    st.sampled_from(["true", "legacy"]),
    LINE,
)


@given(LAWS)
def test_there_and_back(tmp_path_factory, law):
    path = tmp_path_factory.mktemp("law") / "law.json"
    law.write(path)
    assert read_law(path) == law
    assert [entry.name for entry in path.parent.iterdir()] == ["law.json"]
    document = json.loads(path.read_text(encoding="utf-8"))
    assert (document["format"], document["version"]) == ("perilune-network-operator", 1)


def document():
    return json.loads(find_law("diveev_2013").read_text())


def with_cell(row, column, value):
    actual = document()
    actual["matrix"][row - 1][column - 1] = value
    return actual


def without(key):
    return {name: value for name, value in document().items() if name != key}


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (with_cell(8, 3, 5), "matrix[8,3]: 5 is below the diagonal; write 0"),
        (with_cell(16, 1, -1), "matrix[16,1]: -1 is below the diagonal"),
        (with_cell(1, 7, 22), "matrix[1,7]: 22 is not a unary operation; use 0 for no edge, or one of 1, 2,"),
        (with_cell(15, 16, 24), "matrix[15,16]: 24 is not a unary operation"),
        (with_cell(3, 8, -3), "matrix[3,8]: -3 is not a unary operation"),
        (with_cell(16, 16, 4), "matrix[16,16]: 4 is not a binary operation; use one of 0, 1, 2, 3"),
        (with_cell(9, 9, -1), "matrix[9,9]: -1 is not a binary operation"),
        (with_cell(1, 7, 1.0), "matrix[1,7]: 1.0 is not a whole number"),
        (with_cell(8, 3, 0.0), "matrix[8,3]: 0.0 is not a whole number"),
        (with_cell(7, 7, True), "matrix[7,7]: True is not a whole number"),
        (with_cell(2, 7, "1"), "matrix[2,7]: '1' is not a whole number"),
        (with_cell(2, 7, None), "matrix[2,7]: None is not a whole number"),
        (with_cell(2, 7, [1]), "matrix[2,7]: [1] is not a whole number"),
        (document() | {"matrix": document()["matrix"][:15]}, "matrix: 15 row(s), but 16 rows are needed"),
        (document() | {"matrix": [[0] * 15] * 16}, "matrix: row 1 has 15 entries, but 16 are needed"),
        (document() | {"matrix": [*document()["matrix"][:15], 7]}, "matrix: row 16 has 7, but 16 are needed"),
        (document() | {"matrix": "none"}, "matrix: 'none', but 16 rows are needed"),
        (document() | {"q": [1.0, 2.0]}, "q: [1.0, 2.0] is not a list of 3 numbers"),
        (document() | {"q": [1.0, 2.0, "3"]}, "q[3]: '3' is not a finite number"),
        (document() | {"q": [True, 2.0, 3.0]}, "q[1]: True is not a finite number"),
        (document() | {"q": [10**400, 2.0, 3.0]}, "is not a finite number"),
        (document() | {"exp_saturation": True}, "exp_saturation: True is unknown"),
        (document() | {"exp_saturation": "Legacy"}, "exp_saturation: 'Legacy' is unknown"),
        (document() | {"format": "other"}, "format: 'other' is not a law"),
        (document() | {"version": 2}, "version: 2 is unknown; this Perilune reads version 1"),
        (document() | {"version": True}, "version: True is unknown"),
        (document() | {"name": " "}, "name: empty"),
        (document() | {"name": 3}, "name: 3 is not a single line of text"),
        (document() | {"name": "a\u0000b"}, "name: 'a\\x00b' is not a single line of text"),
        (document() | {"description": "two\nlines"}, "description: 'two\\nlines' is not a single line of text"),
        (document() | {"description": "\ud800"}, "is not a single line of text"),
        (document() | {"colour": 1}, "colour: unknown key"),
        (without("matrix"), "matrix: missing"),
        (without("format"), "format: missing"),
        ([1], "not a law"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_mistakes_are_named(tmp_path, content, words):
    path = tmp_path / "law.json"
    path.write_text(json.dumps(content))
    with pytest.raises(InputError) as caught:
        read_law(path)
    assert str(caught.value).startswith(str(path))
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (b"{", "not JSON"),
        (b"", "not JSON"),
        (b"[" * 100_000, "not JSON"),
        (b"\xff", "not UTF-8"),
        (b'{"q": NaN}', "not JSON: NaN is not a number"),
        (b'{"q": 1, "q": 2}', "not JSON: q occurs twice"),
    ],
)
def test_what_is_no_json(tmp_path, text, words):
    path = tmp_path / "law.json"
    path.write_bytes(text)
    with pytest.raises(InputError, match=words):
        read_law(path)


def test_laws_are_found_by_name_then_by_path(tmp_path):
    assert find_law("diveev_2013").name == "diveev_2013.json"
    mine = tmp_path / "mine.json"
    mine.write_text(json.dumps(document()))
    assert find_law("mine.json", tmp_path) == mine
    assert find_law(str(mine)) == mine
    with pytest.raises(InputError, match="no such law or file; use one of diveev_2013, diveev_2013_basic"):
        find_law("diveev")
    with pytest.raises(InputError, match="a folder, not a regular file"):
        read_law(tmp_path)
