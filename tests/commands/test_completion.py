"""What a shell offers: verbs, options, names of systems, campaigns, sets, slots and FMUs, without what flies them.

Truth: the lists that `perilune list` and the folders have; Python's own record of what was imported. The shell's side,
environment variables and a file for the answer, is argcomplete's protocol.
"""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from perilune.analysis.cli import VERBS
from perilune.analysis.new.block import block_slots
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.places import LAWS, SYSTEMS

pytestmark = pytest.mark.usefixtures("fmus")
HEAVY = ("numba", "matplotlib", "scipy", "pyarrow", "control")
SYSTEM_NAMES = {path.parent.name for path in SYSTEMS.glob("*/SystemStructure.ssd")}
RUN = "perilune run lunar_terminal_guidance"


def stems(folder):
    return {path.stem for path in (SYSTEMS / "lunar_terminal_guidance" / folder).iterdir()}


@pytest.fixture
def offered(tmp_path):
    """What follows a line; its last word is what is typed so far."""
    (tmp_path / "mine.toml").write_text("")
    (tmp_path / "notes.txt").write_text("")

    def complete(line):
        answer = tmp_path / "answer"
        environment = os.environ | {
            "_ARGCOMPLETE": "1",
            "_ARGCOMPLETE_SHELL": "bash",
            "_ARGCOMPLETE_IFS": "\n",
            "_ARGCOMPLETE_STDOUT_FILENAME": str(answer),
            "_ARGCOMPLETE_COMP_WORDBREAKS": " \t\n\"'><;|&(:",
            "COMP_LINE": line,
            "COMP_POINT": str(len(line)),
        }
        command = [sys.executable, "-X", "importtime", "-c", "from perilune.analysis.cli import run; run()"]
        done = subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL
        )
        imported = {row.rpartition("|")[2].strip().split(".")[0] for row in done.stderr.splitlines()}
        assert "argcomplete" in imported
        assert not imported & set(HEAVY)
        return {word.strip() for word in answer.read_text().splitlines()}

    return complete


def test_verbs(offered):
    assert set(VERBS) <= offered("perilune ")
    assert offered("perilune sta") == {"stability"}


def test_options_of_a_verb(offered):
    assert {"--use", "--report", "--require", "--fault"} <= offered(f"{RUN} --")
    assert offered(f"{RUN} --flavour ") == {"native", "python"}
    assert {"--t7", "--optimum"} <= offered("perilune plan hover-transfer --")


def test_systems_and_fmus(offered):
    assert offered("perilune run ") >= SYSTEM_NAMES
    assert offered("perilune stability robot_r") == {"robot_rendezvous"}
    assert offered("perilune describe astar_g") == {"astar_guidance"}
    assert SYSTEM_NAMES | set(catalogue()) <= offered("perilune export ")


def test_what_a_system_has(offered):
    campaigns = offered("perilune batch lunar_terminal_guidance --campaign ")
    assert stems("campaigns") | {"mine.toml"} <= campaigns
    assert "notes.txt" not in campaigns
    assert {"noisy.ssv", "exact.ssv"} <= offered(f"{RUN} --parameters ")
    assert offered(f"{RUN} --use ") == {"plant=", "navigation=", "guidance=", "allocation="}
    assert "guidance=astar_guidance" in offered(f"{RUN} --use guidance=astar")


def test_laws_and_slots(offered):
    assert {path.stem for path in LAWS.glob("*.json")} <= offered("perilune law ")
    assert offered("perilune new block mine --slot ") == set(block_slots())


def test_a_system_that_is_not_there_offers_nothing_of_its_own(offered):
    assert offered("perilune run nowhere --use ") == set()
