"""Shell completion of verbs, options and names, without loading the runtime.

Truth: the output of `perilune list` and the folders; Python's list of imported modules. The shell's side (environment
variables, and a file for the answer) is argcomplete's protocol.
"""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from perilune.analysis.authoring.block_template import block_slots
from perilune.analysis.verbs.options.verbs import VERBS
from perilune.common.paths import LAWS, SYSTEMS
from perilune.fmus_src.catalogue import catalogue

pytestmark = pytest.mark.usefixtures("fmus")
HEAVY = ("matplotlib", "scipy", "pyarrow", "control")
SYSTEM_NAMES = {path.parent.name for path in SYSTEMS.glob("*/system.toml")}
RUN = "perilune run lunar_terminal_guidance"


def stems(folder):
    return {path.stem for path in (SYSTEMS / "lunar_terminal_guidance" / folder).iterdir() if path.is_file()}


# Another process, which forks for each line: argcomplete ends the one that it answers in.
COMPLETE = """
import os, sys
from perilune.analysis.cli import run
for number, line in enumerate(sys.argv[1:]):
    if os.fork() == 0:
        os.environ |= {"COMP_LINE": line, "COMP_POINT": str(len(line))}
        os.environ["_ARGCOMPLETE_STDOUT_FILENAME"] = f"answer{number}"
        run()
    assert os.wait()[1] == 0
"""


@pytest.fixture
def offered(tmp_path):
    """Return the completions of some lines; their last word is incomplete."""
    (tmp_path / "mine.toml").write_text("")
    (tmp_path / "notes.txt").write_text("")

    def complete(*lines):
        environment = os.environ | {
            "_ARGCOMPLETE": "1",
            "_ARGCOMPLETE_SHELL": "bash",
            "_ARGCOMPLETE_IFS": "\n",
            "_ARGCOMPLETE_COMP_WORDBREAKS": " \t\n\"'><;|&(:",
        }
        command = [sys.executable, "-X", "importtime", "-c", COMPLETE, *lines]
        done = subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL
        )
        imported = {row.rpartition("|")[2].strip().split(".")[0] for row in done.stderr.splitlines()}
        assert "argcomplete" in imported
        assert not imported & set(HEAVY)
        answers = [(tmp_path / f"answer{number}").read_text() for number in range(len(lines))]
        return [{token.strip() for token in answer.splitlines()} for answer in answers]

    return complete


def test_verbs(offered):
    verbs, one = offered("perilune ", "perilune sta")
    assert {name.split()[0] for name in VERBS} <= verbs
    assert one == {"stability"}


def test_options_of_a_verb(offered):
    options, flavours, of_a_plan = offered(f"{RUN} --", f"{RUN} --flavour ", "perilune design transfer --")
    assert {"--use", "--report", "--require", "--fault"} <= options
    assert flavours == {"native", "python", "fused"}
    assert {"--t7", "--optimum"} <= of_a_plan


def test_systems_and_fmus(offered):
    flown, studied, described, exported = offered(
        "perilune run ", "perilune stability robot_r", "perilune describe astar_g", "perilune export "
    )
    assert flown >= SYSTEM_NAMES
    assert studied == {"robot_rendezvous"}
    assert described == {"astar_guidance"}
    assert SYSTEM_NAMES | set(catalogue()) <= exported


def test_what_a_system_has(offered):
    campaigns, sets, slots, fitting = offered(
        "perilune batch lunar_terminal_guidance --campaign ",
        f"{RUN} --parameters ",
        f"{RUN} --use ",
        f"{RUN} --use guidance=astar",
    )
    assert stems("campaigns") | {"mine.toml"} <= campaigns
    assert "notes.txt" not in campaigns
    assert {"noisy.ssv", "exact.ssv"} <= sets
    assert slots == {"plant=", "navigation=", "guidance=", "allocation="}
    assert "guidance=astar_guidance" in fitting


def test_laws_and_slots(offered):
    laws, slots = offered("perilune design law ", "perilune new block mine --slot ")
    assert {path.stem for path in LAWS.glob("*.json")} <= laws
    assert slots == set(block_slots())


def test_a_system_that_is_not_there_offers_nothing_of_its_own(offered):
    assert offered("perilune run nowhere --use ") == [set()]
