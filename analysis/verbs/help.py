"""Help texts apart from options: verbs by purpose, examples, exit statuses."""

from __future__ import annotations

import argparse
import shutil
import textwrap
from typing import Any, NoReturn

from ..options.declaration import Verb
from .options.verbs import GROUPS, PURPOSES, VERBS

WIDEST = 100  # columns of any output
NAME = 18  # columns of a verb's name


class Formatter(argparse.HelpFormatter):
    """argparse formatter, at most 100 columns wide, that leaves indented lines (examples) unchanged."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=32, width=min(shutil.get_terminal_size().columns, WIDEST))

    def _split_lines(self, text: str, width: int) -> list[str]:
        return textwrap.wrap(" ".join(text.split()), width, break_long_words=False, break_on_hyphens=False)

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return "\n".join(
            line
            if line.startswith(" ")
            else textwrap.fill(line, width, initial_indent=indent, subsequent_indent=indent)
            for line in text.splitlines()
        )


class Parser(argparse.ArgumentParser):
    """argparse parser that reports errors on one line and rejects abbreviated options."""

    def __init__(self, **keywords: Any) -> None:
        super().__init__(**keywords, allow_abbrev=False, formatter_class=Formatter)

    def error(self, message: str) -> NoReturn:
        location = ": ".join(self.prog.split())
        self.exit(2, f"{location}: {message}; see {self.prog} --help\n")


def overview() -> str:
    """Return the verbs by purpose, with an example for each purpose."""
    lines = ["Spacecraft guidance, navigation and control as FMI components."]
    for purpose, verbs in PURPOSES.items():
        lines += ["", f"{purpose}:", *_rows([(verb.name, verb.text) for verb in verbs])]
        examples = [text for verb in verbs for text in verb.examples if f"{text} ".startswith(f"perilune {verb.name} ")]
        lines.append(f"  example: {_break_line(examples[0], 11)}")
    return "\n".join(lines)


def group_help(group: str) -> str:
    """Return the help text of a group: its verbs."""
    rows = [(name.split()[1], verb.text) for name, verb in VERBS.items() if name.split()[0] == group]
    return "\n".join([f"{GROUPS[group]}", "", *_rows(rows)])


def verb_help(verb: Verb) -> str:
    """Return the examples of a verb and the meaning of its exit statuses."""
    examples = "".join(f"  {_break_line(command, 4)}\n      {comment}\n" for command, comment in verb.examples.items())
    return f"Examples:\n{examples}\n{exit_status(verb)}"


def exit_status(verb: Verb) -> str:
    """Return the meaning of a verb's exit statuses."""
    not_met = f"{verb.not_met}, or interrupted" if verb.not_met else "interrupted"
    return f"Exit status: 0: success. 1: {not_met}. 2: wrong input, or a result could not be written."


def _rows(rows: list[tuple[str, str]]) -> list[str]:
    lines = []
    for name, text in rows:
        first, *more = textwrap.wrap(text, WIDEST - NAME - 2)
        lines += [f"  {name:{NAME}}{first}", *(f"  {'':{NAME}}{line}" for line in more)]
    return lines


def _break_line(command: str, indent: int) -> str:
    """Return a shell command broken before options into lines of at most WIDEST columns."""
    lines, first, *others = [], *command.split(" --")
    for other in others:
        if len(first) + len(other) + indent + 6 > WIDEST:
            lines.append(f"{first} \\")
            first = f"{' ' * indent}--{other}"
        else:
            first = f"{first} --{other}"
    return "\n".join([*lines, first])
