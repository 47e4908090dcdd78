"""Every printed command parses to equal options, and is printed identically again.

Truth: the parser of the command line, which shares no text with the writer.
"""

from __future__ import annotations

import shlex
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.analysis.cli import parser_of
from perilune.analysis.options.command import write_command
from perilune.analysis.options.option import Kind, defaults_of, options_of
from perilune.analysis.options.parsing import read_parsed
from perilune.analysis.verbs.options.verbs import GROUPS, VERBS
from tests.support.lengths import either

PLAIN = st.text(alphabet="abcXYZ019._[]", min_size=1, max_size=12)
BLANKS = st.text(alphabet="ab $'\"\\*;-#(){}", min_size=1, max_size=12).filter(lambda text: text.strip() == text)
NAMES = st.from_regex(r"[a-z]{1,6}\.[a-z]{1,6}(\[[1-3]\])?", fullmatch=True)
SET_VALUES = st.one_of(
    st.booleans(),
    st.integers(-5, 5),
    st.floats(allow_nan=False, allow_infinity=False),
    PLAIN,
    st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=2, max_size=3),
)


def numbers(declared, kind):
    """Return numbers within the bounds of an option."""
    option = declared.option
    low = option.minimum if option.minimum is not None else option.above
    if kind is Kind.INTEGER:
        lower = 0 if low is None else int(low) + (option.above is not None)
        return st.integers(lower, lower + 1000 if option.maximum is None else int(option.maximum))
    high = 1e6 if option.maximum is None else option.maximum
    lower = -1e6 if low is None else low
    return st.floats(lower, high, exclude_min=option.above is not None)


def singles(declared, kind):
    if declared.choices:
        return st.sampled_from(declared.choices)
    if kind in (Kind.NUMBER, Kind.INTEGER):
        return numbers(declared, kind)
    # argparse drops a value "--", with which an option begins or ends (python/cpython issue 59317)
    return st.one_of(PLAIN, BLANKS.filter(lambda text: "," not in text)).filter(lambda text: text != "--")


def values(declared):
    """Return values that a Python caller may give an option."""
    if declared.kind is Kind.FLAG:
        return st.booleans()
    if declared.kind is Kind.LIST:
        return st.lists(singles(declared, declared.element), min_size=1, max_size=3).map(tuple)
    if declared.kind is Kind.PAIRS:
        element = SET_VALUES
        if declared.element is Kind.NUMBER:
            element = st.floats(allow_nan=False, allow_infinity=False)
        elif declared.option.comma:
            element = st.lists(PLAIN, min_size=1, max_size=3)
        elif declared.name != "set":
            element = PLAIN
        return st.dictionaries(NAMES, element, min_size=1, max_size=2)
    return singles(declared, declared.kind)


def as_text(value):
    """Return values as a component's parameter gets them, whose type its FMU declares."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list | tuple):
        return ",".join(map(as_text, value))
    return repr(value) if isinstance(value, float) else str(value)


def comparable(declared, value):
    if declared.kind is Kind.PAIRS and declared.element is Kind.TEXT and not declared.option.comma:
        return {name: as_text(each) for name, each in value.items()}
    return value


@pytest.mark.parametrize("name", VERBS)
def test_a_printed_command_parses_back(name):
    verb = VERBS[name]
    declared = options_of(verb.options)
    some = SimpleNamespace(runs=0)

    @settings(max_examples=either(100, 10))
    @given(st.fixed_dictionaries({}, optional={each: values(option) for each, option in declared.items()}))
    def parses_back(options):
        arguments = {
            each.name: ["a b", "c"] if each.many else "3" if each.read is not str else "a b"
            for each in verb.arguments
            if not each.optional
        }
        line = write_command(verb, arguments, options)
        words = shlex.split(line)[1:]
        parsed = parser_of(words).parse_args(words)
        assert (f"{parsed.verb} {parsed.second}" if parsed.verb in GROUPS else parsed.verb) == name
        _, read, _ = read_parsed(verb, parsed)
        complete = defaults_of(verb.options)
        for option, value in (complete | options).items():
            each = declared[option]
            given_value = (complete | read)[option]
            assert comparable(each, given_value) == comparable(each, value), (option, line)
        some.runs += 1

    parses_back()
    assert some.runs
