"""Perilune's components, one Python class each, and their export as FMUs."""

from __future__ import annotations

if __name__ == "fmus_src":  # would create a second copy of every class, whose errors would not be caught
    raise ImportError("fmus_src is a subpackage of perilune: import perilune.fmus_src")
