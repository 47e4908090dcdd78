"""Perilune's components, one Python class each, and their export as FMUs."""

from __future__ import annotations

if __name__ == "fmus_src":  # a second copy of every class, with errors that no handler catches
    raise ImportError("fmus_src is a subpackage of perilune: import perilune.fmus_src")
