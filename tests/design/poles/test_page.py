"""Code of docs/modal_synthesis.md: executed in order, it prints the output on the page.

Truth: the page. The numbers themselves are verified by the other tests of this folder.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys

import pytest

from perilune import modal
from perilune.common.paths import ROOT
from tests.support.documented import page_text

PAGE = page_text("docs/modal_synthesis.md")
BLOCKS = re.findall(r"```python\n(.*?)```\n(?:```text\n(.*?)```\n)?", PAGE, re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]\d+)?")


RUN = """
import contextlib, io, json, sys
names, found = {}, []
for code in json.load(sys.stdin):
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(code, names)
    found.append(printed.getvalue())
print(json.dumps(found))
"""


def test_every_block_prints_what_the_page_says() -> None:
    """In another process, with as many threads of BLAS as a reader's has: searches end elsewhere with another."""
    assert len(BLOCKS) == 8
    threads = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
    done = subprocess.run(
        [sys.executable, "-c", RUN],
        input=json.dumps([code for code, _ in BLOCKS]),
        env={name: value for name, value in os.environ.items() if name not in threads},
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    for (code, expected), printed in zip(BLOCKS, json.loads(done.stdout), strict=True):
        assert words(printed) == words(expected), code
        # rounding differs between processors
        assert numbers(printed) == pytest.approx(numbers(expected), rel=5e-3, abs=2e-6), code


def test_the_page_names_everything_there_is() -> None:
    values = {"CommonFeedback", "DerivativeFeedback", "Observer", "OutputFeedback", "OutputFeedbackSet", "Placement"}
    for name in (
        set(modal.__all__) - values - {"IntegralFeedback", "Reason", "ReducedObserver", "StateFeedback", "SymbolicGain"}
    ):
        assert f"`{name}" in PAGE or f"modal.{name}" in PAGE, name


def words(text: str) -> list[str]:
    return NUMBER.sub("", text).split()


def numbers(text: str) -> list[float]:
    return [float(number) for number in NUMBER.findall(text)]
