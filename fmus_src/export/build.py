"""Build of the FMUs of all blocks into a folder."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar

from tqdm import tqdm

from ..catalogue import catalogue
from ..own_digests import list_own
from .native_fmu import build_native_fmu
from .pythonfmu_fmu import build_python_fmu

T = TypeVar("T")


def build_fmus(flavour: str, output: Path, platforms: Sequence[str], portable: bool) -> int:
    """Build the FMUs of one flavour to ``output``/fmus/FLAVOUR and return their number.

    Python-only blocks have no native FMU. Raises CompilerMissing and CompilationFailed.
    """
    folder, blocks = output / "fmus" / flavour, catalogue()
    names = [name for name, block in blocks.items() if flavour == "python" or not block.python_only]

    def build(name: str) -> Path:
        path = folder / f"{name}.fmu"
        if flavour == "python":
            return build_python_fmu(blocks[name], path)
        return build_native_fmu(blocks[name], path, platforms=platforms, portable=portable)

    # Native FMUs spend their time in compiler processes; pythonfmu's builder changes sys.path.
    threads = 1 if flavour == "python" else os.cpu_count()
    with ThreadPoolExecutor(threads) as pool:
        list_own(folder, list(_progress(pool.map(build, names), f"{flavour} FMUs", len(names))))
    return len(names)


def _progress(work: Iterable[T], what: str, total: int) -> Iterable[T]:
    """Yield the items, with a progress bar on standard error if it is a terminal."""
    return tqdm(work, desc=what, total=total, unit="FMU", disable=None, leave=False)
