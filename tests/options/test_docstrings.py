"""Docstrings of the verbs' functions: Parameters and Example are derived from the declarations.

Truth: the parser of the command line, which reads the same example as a command; Python's `ast` and `inspect`.
"""

from __future__ import annotations

import inspect
import re
import shlex
from importlib import import_module
from types import SimpleNamespace

import pytest

import perilune
from perilune.analysis.cli import main, parser_of
from perilune.analysis.options.docstring import call_of, find_example
from perilune.analysis.options.option import options_of
from perilune.analysis.options.parsing import read_parsed
from perilune.analysis.verbs.options.verbs import VERBS
from tests.support.lengths import LONG

CALLED = [name for name, verb in VERBS.items() if not verb.is_command_alone]
LONGER = {  # examples that `make long` alone carries out
    "run": "320 s of flight with all sensors",
    "batch": "150 flights",
    "merge": "150 flights",
    "compare": "150 flights",
    "replay": "150 flights, of which it simulates one",
    "rare": "thousands of flights",
    "worst": "600 flights",
    "sensitivity": "hundreds of flights",
    "stability": "nine channels and a sweep",
    "design bound": "tests/docs carries out the same command",
    "design bounds": "needs the extra plan",
    "describe": "likewise: tests/docs",
    "export": "likewise: tests/docs",
    "shard": "150 flights",
    "verify": "all trajectories of an FMU",
}
SERVES = "show"  # until Ctrl-C: tests/show/test_process.py
BEFORE = {"replay": ["perilune batch lunar_terminal_guidance --campaign paper --trials 50 --output results"]}


def function_of(name):
    module, function = VERBS[name].home
    return getattr(import_module(f"perilune.analysis.verbs.{module}"), function)


def sections_of(name):
    """Return the lines of a function's sections by their titles, which are underlined."""
    lines = inspect.getdoc(function_of(name)).splitlines()
    starts = [row for row in range(1, len(lines)) if lines[row] and set(lines[row]) == {"-"}]
    return {
        lines[row - 1]: lines[row + 1 : end - 1] for row, end in zip(starts, [*starts[1:], len(lines) + 2], strict=True)
    }


@pytest.mark.parametrize("name", VERBS)
def test_every_parameter_has_its_text_unit_and_default(name):
    parameters = inspect.signature(function_of(name)).parameters
    lines = sections_of(name).get("Parameters", [])
    heads = {re.match(r"\w+", line)[0]: row for row, line in enumerate(lines) if line[:1].strip()}
    assert list(heads) == list(parameters)
    for option, declared in options_of(VERBS[name].options).items():
        head, text = lines[heads[option]], lines[heads[option] + 1]
        assert text.startswith("    ")
        assert text.strip().split()[0].lower() == declared.option.text.split()[0].lower()
        assert declared.option.unit in head
        default = declared.option.default
        assert head.endswith(f", default {default!r}") or not default
        assert all(repr(choice) in head for choice in declared.choices)


@pytest.mark.parametrize("name", VERBS)
def test_lines_are_at_most_a_hundred_columns(name):
    """A type with many choices may be longer."""
    texts = [line for line in sections_of(name).get("Parameters", []) if line.startswith("    ")]
    assert max(map(len, texts), default=0) <= 100


@pytest.mark.parametrize("name", CALLED)
def test_the_example_calls_with_what_the_command_line_reads(name):
    """The call is evaluated with a function in place of the verb's own that stores what it gets."""
    verb, command = VERBS[name], find_example(VERBS[name])
    (line,) = sections_of(name)["Example"]
    assert line == f">>> {call_of(verb, command)}"
    stored = {}

    def store(*arguments, **keywords):
        bound = inspect.signature(function_of(name)).bind(*arguments, **keywords)
        several = [each.name for each in bound.signature.parameters.values() if each.kind is each.VAR_POSITIONAL]
        stored.update(bound.arguments | {key: bound.arguments[key][0] for key in several})

    eval(line.removeprefix(">>> "), {"perilune": SimpleNamespace(**{verb.home[1]: store})})
    words = shlex.split(command)[1:]
    arguments, options, _ = read_parsed(verb, parser_of(words).parse_args(words))
    assert listed(stored) == listed(arguments | options)


def listed(settings):
    return {key: list(each) if isinstance(each, tuple) else each for key, each in settings.items()}


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("name", [name for name in CALLED if name != SERVES])
def test_the_example_runs(name, tmp_path, monkeypatch, capsys):
    if name in LONGER and not LONG:
        pytest.skip(LONGER[name])
    monkeypatch.chdir(tmp_path)
    verb, example = VERBS[name], find_example(VERBS[name])
    for command in [*BEFORE.get(name, []), *verb.examples]:
        if command == example:
            break
        assert main(command.split()[1:]) == 0
    capsys.readouterr()
    (line,) = sections_of(name)["Example"]
    eval(line.removeprefix(">>> "), {"perilune": perilune})
