"""Docstring of a verb's function, derived from the declaration: parameters, and an example call."""

from __future__ import annotations

import re
import shlex
import textwrap
from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Literal, get_args, get_origin

from .declaration import Verb
from .option import Declared, Kind, members_of, options_of
from .option_values import read_value

WIDTH = 100
FLAG = re.compile(r"--([a-z0-9]+(?:-[a-z0-9]+)*)")
NUMBER = frozenset((float, int))


def document_verb(verb: Verb, summary: str, arguments: Iterable[str]) -> str:
    """Return the docstring of a verb's function: its ``summary``, Parameters and Example.

    ``arguments`` are the names of the function's parameters other than options.
    """
    texts = {argument.name: argument.text for argument in verb.arguments} | {**verb.objects}
    lines = [line for name in arguments for line in _entry(argument_head(verb, name), texts[name])]
    for option in options_of(verb.options).values():
        lines += _entry(f"{option.name} : {type_text(option)}", option_text(verb, option))
    sections = [summary]
    if lines:
        sections.append(_section("Parameters", lines))
    if example := find_example(verb):
        sections.append(_section("Example", [f">>> {call_of(verb, example)}"]))
    return "\n\n".join(sections)


def _section(title: str, lines: Iterable[str]) -> str:
    return "\n".join([title, "-" * len(title), *lines])


def _entry(head: str, text: str) -> list[str]:
    sentence = f"{text[0].upper()}{text[1:]}."
    return [head, *textwrap.wrap(sentence, WIDTH, initial_indent="    ", subsequent_indent="    ")]


def argument_head(verb: Verb, name: str) -> str:
    """Return the heading of a parameter that is not an option: its name, and whether it is a list or optional."""
    argument = next((argument for argument in verb.arguments if argument.name == name), None)
    if argument is not None and argument.many:
        return f"{name} : one or a list"
    return f"{name} : optional" if argument is None or argument.optional else name


def type_text(declared: Declared) -> str:
    """Return the type of an option in words, with unit and default."""
    option = declared.option
    unit = f", {option.unit}" if option.unit else ""
    empty: Mapping[Kind, object] = {Kind.LIST: [], Kind.PAIRS: {}}
    return f"{_type_words(declared.annotation)}{unit}, default {empty.get(declared.kind, option.default)!r}"


def _type_words(annotation: object) -> str:
    members = members_of(annotation)
    origins = [get_origin(member) or member for member in members]
    words = []
    for member, origin in zip(members, origins, strict=True):
        inner = get_args(member)
        if origin is Literal:
            words.append(f"{{{', '.join(map(repr, inner))}}}")
        elif origin is PathLike:
            words.append("path")
        elif isinstance(origin, type) and issubclass(origin, Mapping):
            words.append(f"dict of {_type_words(inner[1])} by name")
        elif inner:
            words.append(f"list of {_type_words(inner[0])}")
        elif not (origin is str and PathLike in origins) and not (origin is int and float in origins):
            words.append(getattr(origin, "__name__", str(origin)))
    return " or ".join(words)


def option_text(verb: Verb, declared: Declared) -> str:
    """Return the text of an option, with flags of other options replaced by their Python names."""
    names = {each.flag: f"`{each.name}`" for each in options_of(verb.options).values()}
    return FLAG.sub(lambda match: names.get(match[1], match[0]), declared.option.text)


def find_example(verb: Verb) -> str:
    """Return the first example of a verb that uses options of its function, else its first example.

    The text is empty if the verb has no Python function.
    """
    commands = [command for command in verb.examples if f"{command} ".startswith(f"perilune {verb.name} ")]
    with_options = [command for command in commands if _read_command(verb, command)[1]]
    return "" if verb.is_command_alone else [*with_options, *commands][0]


def call_of(verb: Verb, command: str) -> str:
    """Return a verb's command as a Python call, without options that only the command line has."""
    arguments, options = _read_command(verb, command)
    words, keywords = [], []
    for argument in verb.arguments:
        texts = [repr(argument.read(text)) for text in arguments.get(argument.name, [])]
        if argument.is_option:
            keywords += [f"{argument.name}={text}" for text in texts]
        else:
            words += [f"[{', '.join(texts)}]"] if argument.many else texts
    declared = options_of(verb.options)
    for name, texts in options.items():
        setting = True if declared[name].kind is Kind.FLAG else read_value(declared[name], texts)
        keywords.append(f"{name}={list(setting) if isinstance(setting, tuple) else setting!r}")
    return f"perilune.{verb.home[1]}({', '.join([*words, *keywords])})"


def _read_command(verb: Verb, command: str) -> tuple[dict[str, list[str]], dict[str, list[str]]]:
    """Return the texts of a command's arguments and function options, by name."""
    declared = {f"--{each.flag}": each for group in (verb.options, verb.files) for each in options_of(group).values()}
    required = {f"--{argument.name}": argument.name for argument in verb.arguments if argument.is_option}
    waiting = [argument for argument in verb.arguments if not argument.is_option]
    arguments: dict[str, list[str]] = {}
    options: dict[str, list[str]] = {}
    words = iter(shlex.split(command)[1 + len(verb.name.split()) :])
    for token in words:
        if token in required:
            arguments[required[token]] = [next(words)]
        elif token in declared:
            texts = options.setdefault(declared[token].name, [])
            texts += [] if declared[token].kind is Kind.FLAG else [next(words)]
        else:
            arguments.setdefault(waiting[0].name, []).append(token)
            waiting = waiting if waiting[0].many else waiting[1:]
    return arguments, {name: texts for name, texts in options.items() if name in options_of(verb.options)}
