"""Every verb's declaration, its Python function and its parser agree.

Truth: `inspect.signature`, the parser's actions, and the declaration, each derived separately.
"""

from __future__ import annotations

import inspect
import subprocess
import sys
from importlib import import_module

import pytest

import perilune
from docs.reference.verbs import verb_parser
from perilune.analysis.options.option import options_of
from perilune.analysis.verbs.options.verbs import FORMER, GROUPS, PURPOSES, RENAMED, VERBS

HEAVY = {"numpy", "matplotlib", "scipy", "pyarrow", "lxml", "fmpy", "control", "pandas", "jinja2"}
ALL = pytest.mark.parametrize("name", VERBS)


def function_of(verb):
    module, name = verb.home
    return getattr(import_module(f"perilune.analysis.verbs.{module}"), name)


@ALL
def test_a_verb_is_a_public_function_with_its_options(name):
    verb = VERBS[name]
    function = function_of(verb)
    assert (getattr(perilune, verb.home[1], None) is function) == (not verb.is_command_alone)
    assert inspect.getdoc(function)
    parameters = inspect.signature(function).parameters
    assert not any(each.kind is inspect.Parameter.VAR_KEYWORD for each in parameters.values())
    for option, declared in options_of(verb.options).items():
        assert parameters[option].kind is inspect.Parameter.KEYWORD_ONLY
        assert parameters[option].default == declared.option.default
        assert parameters[option].annotation == declared.annotation
    assert {each.name for each in verb.arguments} <= set(parameters)


@ALL
def test_an_unknown_keyword_raises(name):
    with pytest.raises(TypeError, match="no option 'colour'"):
        function_of(VERBS[name])(colour="red")


@ALL
def test_every_declared_word_has_a_text(name):
    verb = VERBS[name]
    assert sum(verb in verbs for verbs in PURPOSES.values()) == 1
    assert verb.text
    assert verb.examples
    assert verb.name.count(" ") == 0 or verb.name.split()[0] in GROUPS
    declared = [*options_of(verb.options).values(), *options_of(verb.files).values()]
    for each in declared:
        assert each.option.text, each.name
        assert not each.option.text.endswith("."), each.name
        assert not each.option.needs or each.option.needs in {**options_of(verb.options), **options_of(verb.files)}
    names = [each.name for each in declared] + [each.name for each in verb.arguments]
    assert len(names) == len(set(names))
    assert all(each.text for each in verb.arguments)


@ALL
def test_the_parser_has_every_argument_and_option(name):
    verb = VERBS[name]
    actions = {action.dest: action for action in verb_parser(name)._actions}
    declared = [*options_of(verb.options), *options_of(verb.files), *(each.name for each in verb.arguments)]
    assert set(declared) == set(actions) - {"help", "help_all"}


@ALL
def test_help_fits_in_a_hundred_columns(name):
    text = verb_parser(name).format_help()
    assert max(map(len, text.splitlines())) <= 100, text


def test_old_names_lead_to_verbs():
    for old, new in RENAMED.items():
        assert old not in VERBS
        assert any(f"{new} ".startswith(f"{name} ") for name in VERBS), new
    assert not set(FORMER) & set(VERBS)


def test_declarations_import_nothing_heavy():
    """Truth: the modules that a fresh interpreter has after it."""
    code = "import sys, perilune.analysis.cli; from perilune.analysis.cli import parser_of; "
    code += (
        f"parser_of({sorted({token for name in VERBS for token in name.split()})!r}).format_help(); print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {name.partition(".")[0] for name in done.stdout.split()} & HEAVY


@pytest.mark.parametrize("name", [name for name in perilune.__all__ if name[0].islower()])
def test_what_is_public_says_what_it_is(name):
    assert inspect.getdoc(getattr(perilune, name))


def test_one_name_where_a_list_is_meant():
    for keyword in ("parameters", "feedthrough", "no_feedthrough"):
        with pytest.raises(perilune.InputError, match=rf'a single name, but a list is needed; give {keyword}=\["x"\]'):
            perilune.simulate("lunar_terminal_guidance", **{keyword: "x"})
