"""perilune.analysis.campaigns.definition.expressions, compared with Python's arithmetic and math module."""

import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.definition.expressions import FUNCTIONS, Expression, is_name
from perilune.common.errors import InputError

MATH = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "atan2": math.atan2,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "log": math.log,
    "log10": math.log10,
    "abs": abs,
    "min": min,
    "max": max,
    "floor": math.floor,
    "ceil": math.ceil,
    "radians": math.radians,
    "degrees": math.degrees,
    "hypot": math.hypot,
    "sign": lambda x: math.copysign(1.0, x),
    "where": lambda c, a, b: a if c else b,
    "norm": math.hypot,
}


def value(text, **values):
    return Expression(text).evaluate(values)


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_functions_are_those_of_math(name):
    _, fewest, maximum = FUNCTIONS[name]
    arguments = [0.7, -0.3, 0.2, 0.9][: maximum or 4]
    assert len(arguments) >= fewest
    text = f"{name}({', '.join(map(str, arguments))})"
    assert value(text) == pytest.approx(MATH[name](*arguments), rel=1e-15)


# Hypothesis writes an expression twice: for us and for Python, over names whose dots Python cannot hold.
LEAVES = st.sampled_from([("plant.x[1]", "a"), ("b", "b"), ("c.d", "c"), ("2", "2.0"), ("0.5", "0.5")])
TREES = st.recursive(
    LEAVES,
    lambda inner: st.tuples(inner, st.sampled_from(["+", "-", "*", "<", "<=", "==", "!=", ">", ">="]), inner).map(
        lambda t: (f"({t[0][0]} {t[1]} {t[2][0]})", f"({t[0][1]} {t[1]} {t[2][1]})")
    ),
    max_leaves=12,
)
NUMBERS = st.floats(-10, 10)


@given(TREES, NUMBERS, NUMBERS, NUMBERS)
def test_arithmetic_and_comparisons_are_those_of_python(tree, a, b, c):
    ours, python = tree
    assert value(ours, **{"plant.x[1]": a, "b": b, "c.d": c}) == eval(python, {"a": a, "b": b, "c": c})


@given(TREES, st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS), min_size=1, max_size=20))
def test_arrays_give_what_their_elements_give(tree, rows):
    formula = Expression(tree[0])
    columns = dict(zip(["plant.x[1]", "b", "c.d"], np.array(rows).T, strict=True))
    whole = np.broadcast_to(formula.evaluate(columns), len(rows))
    single = [formula.evaluate({name: column[k] for name, column in columns.items()}) for k in range(len(rows))]
    assert whole.tolist() == single


@given(st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=100))
def test_functions_give_the_same_bits_in_arrays_of_any_length(values):
    formula = Expression("sin(x) + atan(x) * cos(x) + exp(-abs(x)) + sqrt(abs(x)) + norm(x, 1, 2)")
    whole = formula.evaluate({"x": np.array(values)})
    strided = formula.evaluate({"x": np.repeat(values, 3)[::3]})
    assert whole.tolist() == strided.tolist() == [formula.evaluate({"x": x}) for x in values]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 < x < 3", 1.0),
        ("1 < x < 2", 0.0),
        ("x > 1 and not y > 1", 0.0),
        ("x > 9 or y == 3", 1.0),
        ("(x > 1) + (y > 1)", 2.0),
        ("(x > 1) - (y > 1)", 0.0),
        ("-(x > 1)", -1.0),
        ("-7 // x", -4.0),
        ("-7 % x", 1.0),
        ("-x ** 2", -4.0),
        ("x\n  + y", 5.0),
        ("e ** 0 + pi * 0", 1.0),
    ],
)
def test_precedence_truth_and_rounding(text, expected):
    assert value(text, x=2, y=3.0) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [("1/0", math.inf), ("-1/0", -math.inf), ("10**10**10", math.inf), ("(-8)**0.5", math.nan), ("log(-1)", math.nan)],
)
def test_arithmetic_is_that_of_doubles(text, expected):
    assert value(text) == pytest.approx(expected, nan_ok=True)


def test_names_are_the_variables_needed():
    formula = Expression("norm(plant.position[1], a[1,2].b, x) + pi + sin(x)")
    assert formula.names == {"plant.position[1]", "a[1,2].b", "x"}


def test_a_component_may_be_called_like_a_function():
    assert value("min.x + pi.y", **{"min.x": 1.0, "pi.y": 2.0}) == 3.0


def test_entries_have_their_keys_in_quotes():
    name = 'a.groups["-2.5"].b[1]'
    assert value(f"{name} + 1", **{name: 2.0}) == 3.0
    assert value("a.groups['-2.5'].b[1]", **{name: 2.0}) == 2.0


def test_deep_comparisons_cost_no_more_than_their_length():
    text = "x"
    for _ in range(60):
        text = f"(0 < {text} < 2)"
    assert value(text, x=1.0) == 1.0


def test_missing_name_is_named_with_the_known_ones():
    with pytest.raises(InputError, match=r"^f: e: 'z' in 'z \+ 1' is unknown; use one of x, y$"):
        Expression("z + 1", ("f", "e")).evaluate({"x": 1, "y": 2})


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "invalid syntax"),
        ("x +", "invalid syntax"),
        ("1if x else 2", "invalid decimal literal"),
        ("x.__class__()", "not a function"),
        ("__import__('os')", "not a function"),
        ("open(x)", "not a function"),
        ("(1).real", "not a name"),
        ("x.y()", "not a function"),
        ("[x]", "not allowed"),
        ("[a for a in x]", "not allowed"),
        ("{'a': 1}", "not allowed"),
        ("lambda: 1", "not allowed"),
        ("(x := 1)", "not allowed"),
        ("f'{x}'", "not allowed"),
        ("'text'", "not allowed"),
        ("True", "not allowed"),
        ("1j", "not allowed"),
        ("x if y else z", "where(condition, a, b)"),
        ("x & y", "'and', 'or'"),
        ("x is y", "not a comparison"),
        ("x in y", "not a comparison"),
        ("sin", "lacks its arguments"),
        ("sin(x, y)", "argument"),
        ("max(x)", "2 or more"),
        ("atan2(x)", "give it 2"),
        ("sin(x=1)", "has a keyword or starred argument"),
        ("sin(*x)", "has a keyword or starred argument"),
        ("x[-1]", "not a name"),
        ("x[0.5]", "not a name"),
        ("x[y]", "not a name"),
        ("x[1][2]", "not a name"),
        ("x[1:2]", "not a name"),
        ("1e999", "out of range"),
        ("9" * 400, "out of range"),
        ("x # y", "comment"),
        ("x = 1", "invalid syntax"),
        ("x; y", "invalid syntax"),
        ("-" * 5000 + "1", "shorter"),
        ("(" * 300 + "1" + ")" * 300, "nested"),
        ("\0", "null"),
    ],
)
def test_everything_else_is_refused_in_one_line(text, says):
    with pytest.raises(InputError) as caught:
        Expression(text, ("c.toml", "metric.m.expression"))
    assert str(caught.value).startswith("c.toml: metric.m.expression: ")
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


def test_travels_to_other_processes():
    formula = pickle.loads(pickle.dumps(Expression("x + 1", ("f", "e"))))
    assert formula.evaluate({"x": 1}) == 2.0
    assert formula.where == ("f", "e")
    assert formula == Expression("x  + 1")


@pytest.mark.parametrize("text", ["x", "plant.position[1]", "a.b.c", "a[1,2].b"])
def test_names(text):
    assert is_name(text)


@pytest.mark.parametrize("text", ["", "1x", "a b", "a.", "a[x]", "a+b", "a[1 ]", "f()", "lambda", "a-b", 'a["b"]'])
def test_no_names(text):
    assert not is_name(text)
