"""Time per call of each elementary function, in C and in Python: `python -m benchmarks.elementary`."""

from __future__ import annotations

import ctypes
import math
import time
from collections.abc import Callable
from functools import partial
from random import Random

import numpy as np

from perilune.analysis.runtime.loop.elementary import elementary
from perilune.analysis.runtime.loop.write_elementary import FUNCTIONS
from perilune.common.paths import BUILD
from perilune.fmus_src.export.compilers import PLATFORMS, local_platform
from perilune.fmus_src.export.judge.subset_table import ELEMENTARY_FUNCTIONS
from perilune.fmus_src.export.libraries import build_library
from perilune.fmus_src.export.native_fmu import native_sources
from perilune.fmus_src.kernel import functions
from tests.support.kernels.elementary_block import ElementaryFunctions

COUNT = 100_000
REPEATS = 7
RANGES = {"asin": (-1.0, 1.0), "acos": (-1.0, 1.0), "log": (0.1, 30.0), "log2": (0.1, 30.0), "log10": (0.1, 30.0)}
RANGES |= {"log1p": (-0.5, 3.0), "pow": (0.1, 3.0)}
USUAL = (-10.0, 10.0)


def library() -> ctypes.CDLL:
    """Return a library with loops over every function, Perilune's and the C library's."""
    main = f"{ElementaryFunctions.fmu_name}.c"
    sources = native_sources(ElementaryFunctions, "{0}")
    text = sources[main].decode()
    for name, function in ELEMENTARY_FUNCTIONS.items():
        home = FUNCTIONS[name].__module__.rpartition(".")[2]
        arguments = "x[i], y[i]" if len(function.takes) == 2 else "x[i]"
        for prefix, called in (("ours", f"{home}_{name}"), ("theirs", name)):
            text += (
                f"void {prefix}_{name}(const double *x, const double *y, double *z)\n"
                f"{{ (void)y; for (int i = 0; i < {COUNT}; i++) z[i] = {called}({arguments}); }}\n"
            )
    platform = local_platform()
    assert platform is not None
    binary = build_library({**sources, main: text.encode()}, main, platform, BUILD / "cache")
    path = BUILD / f"benchmark_elementary{PLATFORMS[platform].extension}"
    path.write_bytes(binary)
    return ctypes.CDLL(str(path))


def shortest(call: Callable[[], object]) -> float:
    """Return the shortest time (s) of several calls."""
    times = []
    for _ in range(REPEATS):
        before = time.perf_counter()
        call()
        times.append(time.perf_counter() - before)
    return min(times)


def call_each(function: Callable[..., float], rows: list[tuple[float, ...]]) -> None:
    """Call a Python function with every row of arguments."""
    for arguments in rows:
        function(*arguments)


def row(dll: ctypes.CDLL, name: str, random: Random) -> str:
    """Return the times of one function: C and arrays in ns, Python in us."""
    draw = [[random.uniform(*RANGES.get(name, USUAL)) for _ in range(COUNT)] for _ in range(2)]
    x, y, z = np.array(draw[0]), np.array(draw[1]), np.empty(COUNT)
    pointers = [ctypes.c_void_p(array.ctypes.data) for array in (x, y, z)]
    two = len(ELEMENTARY_FUNCTIONS[name].takes) == 2
    in_c = [shortest(partial(dll[f"{prefix}_{name}"], *pointers)) / COUNT * 1e9 for prefix in ("ours", "theirs")]
    few = list(zip(*[column[:2000] for column in draw[: 1 + two]], strict=True))
    in_python = [
        shortest(partial(call_each, function, few)) / len(few) * 1e6
        for function in (getattr(functions, name), getattr(math, name))
    ]
    over_array = shortest(partial(elementary(name), *(x, y)[: 1 + two])) / COUNT * 1e9
    return f"| {name} | {in_c[0]:.1f} | {in_c[1]:.1f} | {over_array:.1f} | {in_python[0]:.2f} | {in_python[1]:.2f} |"


def main() -> None:
    """Print the table."""
    dll, random = library(), Random(1)
    print("| function | C, ns | C library, ns | arrays, ns | Python, us | `math`, us |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name in ELEMENTARY_FUNCTIONS:
        print(row(dll, name, random))


if __name__ == "__main__":
    main()
