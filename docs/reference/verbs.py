"""Page of the verbs: description, options, examples and exit status, from the parser."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from perilune.analysis.cli import HELP_ALL, parser_of
from perilune.analysis.options.declaration import Verb
from perilune.analysis.options.docstring import call_of, find_example
from perilune.analysis.verbs.help import exit_status
from perilune.analysis.verbs.options.verbs import VERBS

from .markdown import escaped, table


def verbs_page() -> str:
    """Return the Markdown page of all verbs, for reference."""
    rows = [[f"[{name}](#{name.replace(' ', '-')})", escaped(verb.text)] for name, verb in VERBS.items()]
    parts = [
        "# Verbs",
        "Output of `perilune VERB --help-all`. [The command line](../command_line.md) explains how options combine.",
        table(["verb", "what it does"], rows),
    ]
    for name, verb in VERBS.items():
        examples = "\n".join(f"# {comment}\n{command}" for command, comment in verb.examples.items())
        parts += [f"## {name}", escaped(verb.text[0].upper() + verb.text[1:]) + ".", f"```sh\n{examples}\n```"]
        parts += [*_call(verb), *_options(verb_parser(name)), exit_status(verb)]
    return "\n\n".join(parts) + "\n"


def _call(verb: Verb) -> Iterator[str]:
    """Yield the example of the function's docstring as Markdown."""
    if example := find_example(verb):
        yield f"In Python, where `help(perilune.{verb.home[1]})` has its parameters:"
        yield f"```python\n{call_of(verb, example)}\n```"


def verb_parser(name: str) -> argparse.ArgumentParser:
    """Return the parser of a verb with all options explained."""
    parser: argparse.ArgumentParser = parser_of([*name.split(), HELP_ALL])
    for token in name.split():
        (choices,) = (each.choices for each in parser._actions if isinstance(each, argparse._SubParsersAction))
        parser = choices[token]
    return parser


def _options(parser: argparse.ArgumentParser) -> Iterator[str]:
    """Yield a table for each group of options."""
    for group in parser._action_groups:
        rows = [[_name(action), escaped(action.help or "")] for action in group._group_actions]
        if rows and group.title != "help":
            yield table([group.title or "", ""], rows)


def _name(action: argparse.Action) -> str:
    values = f"{{{','.join(map(str, action.choices))}}}" if action.choices else action.dest.upper()
    metavar = str(action.metavar or values)
    if not action.option_strings:
        return f"`{metavar}`"
    option = ", ".join(action.option_strings)
    return f"`{option}`" if action.nargs == 0 else f"`{option} {metavar}`"
