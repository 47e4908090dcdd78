"""Targets of Python under atheris, which looks for inputs that reach other code."""

from __future__ import annotations

import ctypes
import os
import random
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

END = ctypes.CFUNCTYPE(None, ctypes.c_int, ctypes.c_void_p)(lambda status, _: os._exit(status))
SEEDS, LONGEST = 20, 4096  # inputs to begin with, bytes
LIMITS = ["-timeout=20", "-rss_limit_mb=2500", "-len_control=0", f"-max_len={LONGEST}"]  # s for one input, memory


def fuzz(name: str, folder: Path, runs: int) -> None:
    """Run ``runs`` inputs of a target of `targets`; end the process: status 0 where all went well."""
    import atheris  # not among the packages of development: `make fuzz` installs it

    with atheris.instrument_imports(include=["perilune"]):
        from tests.fuzz.targets import TARGETS
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    target: Callable[[], None] = TARGETS[name](folder)
    one_input = target.hypothesis.fuzz_one_input  # type: ignore[attr-defined]

    def execute(data: bytes) -> None:
        one_input(data)

    corpus = folder / "corpus"
    corpus.mkdir()
    for seed in range(SEEDS):
        (corpus / f"seed_{seed}").write_bytes(random.Random(seed).randbytes(LONGEST // 4))
    options = [f"-runs={runs}", *LIMITS, "-seed=1", f"-artifact_prefix={folder}/", str(corpus)]
    atheris.Setup([sys.argv[0], *options], execute)
    # libFuzzer ends its runs by exit(), in which destructors of pyarrow may wait for its threads for ever
    ctypes.CDLL(None).on_exit(END, None)
    atheris.Fuzz()
