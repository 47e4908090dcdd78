"""The check of a block: a short reference trajectory, which its FMU carries for whoever imports it."""

from __future__ import annotations

import sys
from pathlib import Path

from .block import Block

ARCHIVE_FOLDER = "extra/org.perilune"


def check_files(block_class: type[Block]) -> dict[str, bytes]:
    """Archive name -> content: checks/NAME.csv and checks/NAME.toml of the folder of the block's file, if they exist.

    Raises ValueError where one exists without the other.
    """
    source = getattr(sys.modules.get(block_class.__module__), "__file__", None)
    if source is None:
        return {}
    paths = {suffix: Path(source).parent / "checks" / f"{block_class.fmu_name}{suffix}" for suffix in (".csv", ".toml")}
    missing = [path for path in paths.values() if not path.is_file()]
    if len(missing) == 1:
        raise ValueError(f"{missing[0]}: no such file; a check is a trajectory, .csv, and its tolerances, .toml")
    return {} if missing else {f"{ARCHIVE_FOLDER}/check{suffix}": path.read_bytes() for suffix, path in paths.items()}
