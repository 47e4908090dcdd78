"""The solvers of the optional extra `plan`, asked for where they are needed; what needs none works without them."""

from __future__ import annotations

import importlib
from functools import cache
from typing import Any

from ...common.errors import InputError


@cache
def casadi() -> Any:
    """CasADi with IPOPT, for direct methods."""
    return _solver("casadi", "the true optimum")


@cache
def clarabel() -> Any:
    """Clarabel, for the convex form."""
    return _solver("clarabel", "the bound")


def _solver(name: str, what: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        remedy = "pip install 'perilune[plan]'"
        raise InputError("plan", name, f"{what} needs it, and it is not installed", remedy) from error
