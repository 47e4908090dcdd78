"""Imports of the solvers of the optional extra `plan`, on demand: everything else works without them."""

from __future__ import annotations

import importlib
from functools import cache
from types import ModuleType
from typing import Any

from ....common.errors import InputError

Symbol = Any  # CasADi expression, untyped; a number or an array may replace it


@cache
def casadi() -> ModuleType:
    return _solver("casadi", "the true optimum")


@cache
def clarabel() -> ModuleType:
    return _solver("clarabel", "the bound")


def _solver(name: str, what: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        remedy = "pip install 'perilune[plan]'"
        raise InputError("plan", name, f"{what} needs this package, which is not installed", remedy) from error
