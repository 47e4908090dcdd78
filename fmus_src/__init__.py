"""Perilune's components, one Python class each, and what turns them into FMUs."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from .face import HOME_OF

if __name__ == "fmus_src":  # a second copy of every class, whose errors nobody would catch
    raise ImportError("fmus_src is a room of the package perilune: import perilune.fmus_src")


def __getattr__(name: str) -> Any:
    """What one needs to write a block (`face`), imported when it is first asked for."""
    if name in HOME_OF:
        return getattr(import_module(f".{HOME_OF[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
