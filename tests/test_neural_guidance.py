"""Guidance of docs/guides/neural_network_guidance.md, trained, built and simulated as on the page.

Truth: the limits of the landing for initial states of the campaign that are not training data; the gradient by
differences.
"""

import subprocess
import sys

import pytest

import perilune
from tests.support.documented import page_text, saved_files
from tests.support.lengths import LONG

PAGE = "docs/guides/neural_network_guidance.md"
GRADIENT = """
from train_network import *
from scipy.optimize import check_grad
weights = random.normal(0.0, 0.3, count)
assert check_grad(lambda w: misfit(w)[0], lambda w: misfit(w)[1], weights) < 1e-5
"""


@pytest.mark.skipif(
    not LONG, reason="trains a network and flies it in Python; tests/docs/reference/test_commands.py does too"
)
@pytest.mark.usefixtures("fmus")
def test_the_network_lands_from_starts_that_it_has_not_seen(tmp_path, monkeypatch):
    for name, content in saved_files(page_text(PAGE)):
        (tmp_path / name).write_text(content, encoding="utf-8")
    subprocess.run([sys.executable, "-c", GRADIENT], cwd=tmp_path, check=True)
    monkeypatch.chdir(tmp_path)
    perilune.export("neural_guidance")
    flown = perilune.batch(
        "lunar_terminal_guidance",
        campaign="paper",
        trials=4,
        seed=7,
        workers=1,
        compare={"guidance": ["neural_guidance"]},
    )
    table = flown.to_pandas()
    assert table["success"].all()
    assert table["metric.position_error"].max() < 0.1
    assert table["metric.velocity_error"].max() < 1.0
