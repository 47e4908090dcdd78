"""Declaration of a verb: name, arguments, options and examples.

Declarations do not import the code of their verbs, which keeps help and completion fast.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypedDict

from .system import JsonFile


class NoOptions(TypedDict):
    """Options of a verb that has none"""


@dataclass(frozen=True)
class Argument:
    """A positional argument of a verb, or with ``is_option`` a required option of the command line.

    ``name`` is the parameter of the Python function. ``read`` converts the text; ``many`` accepts one or more,
    ``optional`` at most one.
    """

    name: str
    metavar: str
    text: str
    completer: str = ""
    many: bool = False
    optional: bool = False
    is_option: bool = False
    read: Callable[[str], object] = str


@dataclass(frozen=True)
class Verb:
    """Declaration of a verb, from which command line, signature and documentation derive.

    ``name`` is the name on the command line (two words for a verb of a group). ``options`` are common to command line
    and Python function; ``files`` are output files of the command line only. ``function`` is the Python function if it
    is not NAME.NAME. ``examples`` are commands with comments; ``not_met`` explains exit status 1, apart from an
    interruption. ``is_command_alone`` marks a verb without use in Python. ``objects`` are parameters of the Python
    function only, each in place of several options, with their texts.
    """

    name: str
    text: str
    arguments: tuple[Argument, ...] = ()
    options: type = NoOptions
    files: type = JsonFile
    function: str = ""
    examples: Mapping[str, str] = field(default_factory=dict)
    not_met: str = ""
    is_command_alone: bool = False
    objects: Mapping[str, str] = field(default_factory=dict)

    @property
    def home(self) -> tuple[str, str]:
        """The module below `verbs`, and the function in it."""
        module, _, function = self.function.partition(".")
        return module or self.name, function or self.name
