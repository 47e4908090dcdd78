"""The options of perilune list."""

from __future__ import annotations

import argparse

from ..common.options import add_json


def add(parser: argparse.ArgumentParser) -> None:
    add_json(parser)
