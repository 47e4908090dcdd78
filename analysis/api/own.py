"""Blocks and systems of one's own to start from."""

from __future__ import annotations

from pathlib import Path

from ..authoring.new import block, system


def new_block(name: str, slot: str | None = None) -> list[Path]:
    """Write NAME.py with a block in the working folder: `perilune new block`; the paths of what was written.

    ``slot`` is the interface of the guidance, filter or allocation that it is to be. Raises InputError.
    """
    return block.new_block(name, slot).paths


def new_system(name: str) -> list[Path]:
    """Write a folder NAME with a plant, a controller and what it takes to fly them: `perilune new system`."""
    return system.new_system(name).paths
