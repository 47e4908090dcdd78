"""Every verb of the command line is a function, with the same options by the same names and defaults.

Truth: the parsers of the command line; the fields of `SystemOptions`.
"""

from __future__ import annotations

import argparse
import inspect
from dataclasses import fields
from typing import get_type_hints

import pytest
from perilune.analysis.commands.asked.campaigns import batch, rare, replay, shard, worst

import perilune
from perilune.analysis.cli import VERBS
from perilune.analysis.commands.asked import describe, export, run, stability, synthesize
from perilune.analysis.runtime.system.options import SystemOptions

FUNCTIONS = {
    "list": "inventory", "describe": "describe", "validate": "validate", "run": "simulate", "batch": "batch",
    "shard": "shard", "merge": "merge", "replay": "replay", "rare": "rare", "worst": "worst", "compare": "compare",
    "law": "law", "synthesize": "synthesize", "plan": "plan_hover_transfer", "stability": "stability",
    "new": "new_block", "benchmark": "benchmark", "export": "export",
}  # fmt: skip
# Options that are something else in Python: methods of the result, its values, or another name.
PRINTED = {"help", "json", "report", "data", "require", "replay", "output", "prepare"}
APART = {"batch": {"sensitivity", "hold", "noise_trial"}}  # a function of its own

NAMES = {"loop": "loops", "fault": "faults", "platform": "platforms"}
COMMANDS = {
    "simulate": run,
    "batch": batch,
    "shard": shard,
    "rare": rare,
    "replay": replay,
    "worst": worst,
    "stability": stability,
    "describe": describe,
    "export": export,
    "synthesize": synthesize,
}


def test_every_verb_has_its_function():
    assert set(FUNCTIONS) == set(VERBS)
    for name in FUNCTIONS.values():
        assert name in perilune.__all__
        assert callable(getattr(perilune, name))


@pytest.mark.parametrize("name", COMMANDS)
def test_options_of_the_command_are_keywords(name):
    parser = argparse.ArgumentParser()
    COMMANDS[name].add(parser)
    options = {action.dest: action for action in parser._actions if action.option_strings and not action.required}
    keywords = inspect.signature(getattr(perilune, name)).parameters
    for option, action in options.items():
        if option in PRINTED | APART.get(name, set()):
            continue
        parameter = keywords[option if option in keywords else NAMES[option]]
        assert parameter.kind is inspect.Parameter.KEYWORD_ONLY
        assert (parameter.default or None) == (action.default or None), option


@pytest.mark.parametrize("name", ["simulate", "batch", "rare", "worst", "sensitivity", "stability", "describe"])
def test_system_options_are_spelled_out_with_their_types(name):
    function = getattr(perilune, name)
    parameters, hints = inspect.signature(function).parameters, get_type_hints(function)
    assert not any(parameter.kind is inspect.Parameter.VAR_KEYWORD for parameter in parameters.values())
    for field in fields(SystemOptions):
        if not field.compare or field.name == "places":  # where paths are meant from, where files write values
            continue
        assert field.name in parameters
        assert field.name in hints


@pytest.mark.parametrize("name", [name for name in perilune.__all__ if name[0].islower()])
def test_what_is_public_says_what_it_is(name):
    assert inspect.getdoc(getattr(perilune, name))


def test_one_name_where_a_list_is_meant():
    for keyword in ("parameters", "feedthrough", "no_feedthrough"):
        with pytest.raises(perilune.InputError, match=rf'one name where a list is meant; give {keyword}=\["x"\]'):
            perilune.simulate("lunar_terminal_guidance", **{keyword: "x"})
    with pytest.raises(perilune.InputError, match="one name where a list is meant"):
        perilune.stability("lunar_terminal_guidance", loops="thrust")


def test_a_platform_that_is_none():
    with pytest.raises(perilune.InputError, match="platforms: linux32: no such platform; use one of"):
        perilune.export("ideal_navigation", platforms=["linux32"])
