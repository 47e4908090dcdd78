"""The child process in which one importer flies one FMU: `python -m tests.importers.worker MASTER FMU FLIGHT`."""

from __future__ import annotations

import json
import os
import sys
import tempfile
from pathlib import Path

from .masters import MASTERS, Flight

MARK = "values: "  # importers print, too


def main() -> None:
    name, fmu, text = sys.argv[1:]
    stated = json.loads(text)
    change = None if stated["change"] is None else (stated["change"][0], stated["change"][1])
    flight = Flight(**stated | {"outputs": tuple(stated["outputs"]), "change": change})
    with tempfile.TemporaryDirectory() as folder:
        outputs = MASTERS[name](Path(fmu), flight, Path(folder))
    print(MARK + json.dumps({key: number.hex() for key, number in outputs.items()}), flush=True)
    os._exit(0)  # what importers and loaders do at the end of a process is not what is tried here


if __name__ == "__main__":
    main()
