"""perilune new: a block or a system of one's own to start from."""

from __future__ import annotations

import argparse

from ..authoring.new.block import Written, new_block
from ..authoring.new.system import new_system
from .asked.new import BLOCK
from .common.options import check_json, tell


def run(options: argparse.Namespace) -> int:
    check_json(options)
    written = new_block(options.name, options.slot) if options.kind == BLOCK else new_system(options.name)
    document = {"paths": [path.as_posix() for path in written.paths], "next": written.commands}
    return tell(document, options, lambda: _print(written))


def _print(written: Written) -> None:
    print(f"written: {', '.join(map(str, written.paths))}")
    print("next:")
    for command in written.commands:
        print(f"  {command}")
