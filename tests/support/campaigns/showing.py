"""`perilune show` in another process, as a user starts it."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest

from perilune.analysis.documents.interactive.script_bundles import MISSING, read_bundle
from perilune.common.paths import ROOT

COMMAND = "from perilune.analysis.cli import run; run()"
PATIENCE = 60.0  # s


@contextmanager
def showing(folders: Sequence[Path], *options: str, before: str = "") -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """Yield the printed address and the process, which is ended by Ctrl-C unless it has ended already.

    ``before`` are statements that the process begins with.
    """
    if read_bundle("show") is None:
        pytest.skip(MISSING)
    process = subprocess.Popen(
        [sys.executable, "-c", before + COMMAND, "show", *map(str, folders), *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        # as in a terminal, also where a shell in the background has SIGINT ignored
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        assert process.stdout is not None
        line = process.stdout.readline()
        assert line.startswith("open http://"), (line, process.stderr and process.stderr.read())
        yield line.split()[1], process
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
