"""One importer flying one FMU, alone in a process: `python -m tests.importers.worker MASTER FMU STEP STEPS OUTPUT`."""

from __future__ import annotations

import json
import os
import sys
import tempfile
from pathlib import Path

from .masters import MASTERS

MARK = "values: "  # importers print, too


def main() -> None:
    name, fmu, step, steps, *outputs = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        values = MASTERS[name](Path(fmu), float(step), int(steps), outputs, Path(folder))
    print(MARK + json.dumps({key: number.hex() for key, number in values.items()}), flush=True)
    os._exit(0)  # what importers and loaders do at the end of a process is not what is tried here


if __name__ == "__main__":
    main()
