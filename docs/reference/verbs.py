"""The page of the verbs: what each does, its options, examples and exit status, as its parser has them."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from perilune.analysis.cli import VERBS, exit_status, parser_of
from perilune.analysis.examples import EXAMPLES

from .markdown import escaped, table


def verbs_page() -> str:
    """Markdown of all verbs, to lie in reference."""
    parts = [
        "# Verbs",
        "What `perilune VERB --help` prints. [The command line](../command_line.md) says how options work together.",
        table(["verb", "what it does"], [[f"[{verb}](#{verb})", escaped(words)] for verb, words in VERBS.items()]),
    ]
    for verb, words in VERBS.items():
        parser = _verb_parser(verb)
        examples = "\n".join(f"# {comment}\n{command}" for command, comment in EXAMPLES.get(verb, ()))
        parts += [f"## {verb}", escaped(words[0].upper() + words[1:]) + "."]
        parts += [f"```sh\n{examples}\n```"] if examples else []
        parts += list(_options(parser))
        parts.append(exit_status(verb))
    return "\n\n".join(parts) + "\n"


def _verb_parser(verb: str) -> argparse.ArgumentParser:
    return _sub_parsers(parser_of([verb]))[verb]


def _sub_parsers(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            return dict(action.choices)
    return {}


def _options(parser: argparse.ArgumentParser) -> Iterator[str]:
    """A table for each group of options; those of its own verbs after them."""
    own = _sub_parsers(parser)
    for group in parser._action_groups:
        shown = [action for action in group._group_actions if action.help != argparse.SUPPRESS and not own]
        rows = [[_name(action), escaped(_help(action))] for action in shown if action.dest != "help"]
        if rows:
            yield table([(group.title or "").replace("positional ", ""), ""], rows)
    for name, inner in own.items():
        yield f"### {parser.prog.split()[-1]} {name}"
        yield escaped((inner.description or "")[:1].upper() + (inner.description or "")[1:]) + "."
        yield from _options(inner)


def _name(action: argparse.Action) -> str:
    values = f"{{{','.join(map(str, action.choices))}}}" if action.choices else action.dest.upper()
    metavar = str(action.metavar or values)
    if not action.option_strings:
        return f"`{metavar}`"
    option = ", ".join(action.option_strings)
    return f"`{option}`" if action.nargs == 0 else f"`{option} {metavar}`"


def _help(action: argparse.Action) -> str:
    text = action.help or ""
    if isinstance(action, argparse._AppendAction):
        text += "; may be repeated"
    return text
