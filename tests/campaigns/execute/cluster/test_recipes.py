"""Recipes of docs/studies/clusters.md as printed, and shards simulated by processes that are killed.

Truth: every file that the same campaign writes in one command.
"""

import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

from perilune.analysis.cli import main
from tests.support.campaigns.folders import bytes_of, killed_when, shards_in, started
from tests.support.documented import commands_in, page_text, saved_files
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
PAGE = page_text("docs/studies/clusters.md")
PREPARE = next(command for command in commands_in(PAGE) if command.startswith("perilune prepare"))


@pytest.fixture(scope="module")
def whole(tmp_path_factory, fmus):
    out = tmp_path_factory.mktemp("whole") / "parts"
    words = PREPARE.replace("perilune prepare", "perilune batch").replace(" parts", f" {out}").split()[1:]
    assert main(words) == 0
    return bytes_of(out)


@pytest.mark.skipif(sys.platform == "win32", reason="seq and xargs are a shell's")
@pytest.mark.slow  # by processes, as test_shard_processes_that_are_killed; tests/docs carries out the rest of the page
@pytest.mark.parametrize("beginning", ["python fly_hyperqueue.py", "seq 0 3 | xargs"])
def test_a_recipe(whole, tmp_path, monkeypatch, beginning):
    if "hyperqueue" in beginning:
        pytest.importorskip("hyperqueue", reason="its wheels are for Linux only")
    monkeypatch.chdir(tmp_path)
    for name, content in saved_files(PAGE):
        (tmp_path / name).write_text(content, encoding="utf-8")
    assert main(PREPARE.split()[1:]) == 0
    recipe = next(command for command in commands_in(PAGE) if command.startswith(beginning))
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    subprocess.run(["bash", "-c", recipe], env={**os.environ, "PATH": path}, capture_output=True, check=True)
    assert main(["merge", "parts"]) == 0
    assert bytes_of(tmp_path / "parts") == whole


def test_shard_processes_that_are_killed(tmp_path):
    """A loop that flies what is missing, and is killed after each shard that it has written, or while it writes it."""
    trials, kills = either((2000, 20), (75, 1))
    source = random.Random(23)
    command = ["batch", "lunar_terminal_guidance", "--campaign", "paper", "--trials", str(trials)]
    parts, left = tmp_path / "parts", tmp_path / "left"
    assert main(["prepare", *command[1:], "--output", str(parts)]) == 0
    count = -(-trials // max(25, -(-trials // 40)))
    for kill in range(kills):
        wanted = 1 + kill * (count * 3 // 4) // kills
        first = source.randrange(2)  # 0: from the first one on
        order = [f"{first}-{count - 1}", *(["0"] if first else [])]
        process = started("shard", parts, *order, "--workers", "2")
        assert killed_when(process, lambda wanted=wanted: shards_in(parts) >= wanted)
        process.communicate()
    assert main(["shard", str(parts), f"0-{count - 1}"]) == 0
    assert main(["merge", str(parts)]) == 0
    assert main([*command, "--output", str(left)]) == 0
    actual = {name: digest for name, digest in bytes_of(parts).items() if not Path(name).name.startswith(".")}
    assert actual == bytes_of(left)
