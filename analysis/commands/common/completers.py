"""Completion, for commands that are not verbs yet."""

import argparse

from ...verbs.options.completers import *  # noqa: F403
from ...verbs.options.completers import Completer


def completed(action: argparse.Action, completer: Completer) -> None:
    vars(action)["completer"] = completer
