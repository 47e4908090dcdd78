"""The command line of build_fmus.py."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ..block import Block
from ..catalogue import blocks_in_file, catalogue
from .pythonfmu_fmu import build_python_fmu
from .ssp_package import pack_system

ROOT = Path(__file__).parents[2]


def main(arguments: Sequence[str] | None = None) -> int:
    """Build FMUs and systems; returns the exit status (2 for wrong input)."""
    parser = argparse.ArgumentParser(prog="build_fmus.py", description=__doc__)
    parser.add_argument("--blocks", type=Path, metavar="FILE", help="build the blocks of this file only")
    parser.add_argument("--output", type=Path, metavar="DIR", default=ROOT / "build", help="default: build")
    options = parser.parse_args(arguments)
    try:
        blocks = catalogue() if options.blocks is None else _blocks_of(options.blocks)
        for name, block in blocks.items():
            build_python_fmu(block, options.output / "fmus" / "python" / f"{name}.fmu")
        print(f"{len(blocks)} FMUs in {options.output / 'fmus'}")
        if options.blocks is None:
            for folder in sorted(path.parent for path in (ROOT / "ssp_systems").glob("*/SystemStructure.ssd")):
                print(pack_system(folder, options.output / "fmus" / "python", options.output / "ssp"))
    except ValueError as error:
        print(f"build_fmus.py: {error}", file=sys.stderr)
        return 2
    return 0


def _blocks_of(path: Path) -> dict[str, type[Block]]:
    return {block.fmu_name: block for block in blocks_in_file(path)}
