"""Tables of both codes for one case: ours here, Basilisk's by a process in its environment."""

import json
import subprocess
import tempfile
from importlib import import_module
from pathlib import Path

from crosscheck.table import Table, read_table

ROOT = Path(__file__).parents[1]
FUNCTIONS = {"cases": "simulate", "models": "evaluate", "swings": "simulate"}  # of ours.py, by folder


def tables(folder: str, name: str, python: str, *number: float) -> tuple[Table, Table]:
    """Return our table and Basilisk's, for a step or an amplitude where the folder's cases have one.

    Where ``ours.py`` has a function ``handed_over``, Basilisk's side gets what it returns (coefficients of our models,
    positions of Sun and Moon) by a JSON file, every number exactly.
    """
    ours = import_module(f"crosscheck.{folder}.{name}.ours")
    with tempfile.TemporaryDirectory() as temporary:
        file, handed = Path(temporary) / "basilisk.csv", Path(temporary) / "handed_over.json"
        if hasattr(ours, "handed_over"):
            handed.write_text(json.dumps(ours.handed_over(*number)), encoding="utf-8")
        command = [python, "-W", "ignore", "-m", "crosscheck.basilisk_side", f"{folder}.{name}", str(file), str(handed)]
        subprocess.run([*command, *map(repr, number)], cwd=ROOT, check=True)
        return getattr(ours, FUNCTIONS[folder])(*number), read_table(file)
