"""`perilune design search`: output, JSON, exit status, an interruption from the keyboard.

Truth: `run_synthesis` with the same file; an uninterrupted search.
"""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
from lxml import etree

from perilune.analysis.cli import main
from perilune.analysis.design.synthesis.synthesis import run_synthesis
from perilune.analysis.design.synthesis.synthesis_file import read_synthesis
from perilune.analysis.documents.of.design.synthesis import synthesis_document
from perilune.analysis.documents.render.terminal import document_lines
from tests.support.laws.campaign_text import CAMPAIGN, TEXT

pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "search.toml"
    path.write_text(TEXT)
    return path


def test_prints_and_writes_what_was_found(file, tmp_path, capsys):
    out = tmp_path / "new" / "out"
    command = ["design", "search", str(file), "--seed", "5", "--workers", "1", "--output", str(out)]
    expected = run_synthesis(read_synthesis(file), seed=5, workers=1)
    chosen = expected.search.choose().evaluation
    assert chosen.successes < chosen.flown == 4, "three generations have become enough: take fewer"
    assert main(command) == 1
    captured = capsys.readouterr()
    assert captured.err.count("\n") == 1
    assert f"search.toml: no law found: the chosen one succeeds in {chosen.successes} of 4 trials; " in captured.err
    for name, total in zip(("altitude", "speed"), chosen.objectives, strict=True):
        assert f"{name} {total / 4:.6g} per flight ({total:.6g} over 4)" in captured.out
    assert captured.out == "\n".join(document_lines(synthesis_document(expected))) + f"\nwritten: {out}\n"
    assert etree.parse(out / "law.svg").getroot().tag == "{http://www.w3.org/2000/svg}svg"
    assert json.loads((out / "pareto.json").read_text()) == expected.content()
    assert main([*command, "--resume", "--json", "-"]) == 1
    assert json.loads(capsys.readouterr().out) == expected.content()
    fly = ["run", "lunar_descent_2d", "--parameters", str(out / "law.ssv"), "--stop-time", "10"]
    assert main(fly) == 1  # nowhere near the limits yet


def test_a_law_that_is_found_ends_with_status_0(file, capsys):
    file.write_text(TEXT.replace("final_speed < 6 and 1200 <= final_altitude <= 1800", "final_speed >= 0"))
    assert main(["design", "search", str(file), "--workers", "1", "--json", "-"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    actual = json.loads(captured.out)
    assert (actual["ended"], actual["chosen"]["successes"], actual["chosen"]["flights"]) == ("success", 4, 4)


def test_evaluations_limit_the_search(file, capsys):
    command = ["design", "search", str(file), "--workers", "1", "--evaluations", "9", "--json", "-"]
    assert main(command) == 1
    actual = json.loads(capsys.readouterr().out)
    assert actual["ended"] == "evaluations"
    assert actual["evaluations"] >= 9
    assert actual["generations"] < 3


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["none.toml"], "none.toml: not found"),
        (["campaign.toml"], "campaign.toml: network_operator: missing"),
        (["search.toml", "--resume"], "--resume: no folder to resume from"),
        (["search.toml", "--workers", "0"], "--workers: 0"),
        (["search.toml", "--evaluations", "-3"], "--evaluations: -3"),
        (["search.toml", "--seed", "-3"], "seed: -3 is negative"),
    ],
)
def test_wrong_input(file, tmp_path, monkeypatch, capsys, arguments, words):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    assert main(["design", "search", *arguments]) == 2
    error = capsys.readouterr().err
    assert error.startswith("perilune: ")
    assert words in error
    assert error.count("\n") == 1


def test_a_search_is_validated_and_not_flown_as_a_batch(file, capsys):
    assert main(["validate", str(file)]) == 0
    assert main(["batch", "lunar_descent_2d", "--campaign", str(file)]) == 2
    error = capsys.readouterr().err
    assert "network_operator: declares a search, which perilune batch cannot run" in error
    assert error.count("\n") == 1


def test_an_interruption_leaves_a_checkpoint_to_go_on_from(tmp_path):
    file = tmp_path / "search.toml"
    file.write_text(TEXT.replace("generations = 3", "generations = 400"))
    out = tmp_path / "out"
    program = "import sys; from perilune.analysis.cli import run; sys.argv[0] = 'perilune'; run()"
    command = [sys.executable, "-c", program, "design", "search", str(file), "--output", str(out)]
    search = subprocess.Popen(
        [*command, "--workers", "2"],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        # a shell that runs the tests in the background hands SIGINT down as ignored
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    while not (out / "checkpoint.json").exists() and search.poll() is None:
        time.sleep(0.05)
    os.kill(search.pid, signal.SIGINT)
    output, error = search.communicate()
    assert search.returncode == 1, error
    assert error == "perilune: interrupted\n"
    assert output == ""
    assert not list(out.glob(".*")), "a partial file was left"
    reached = json.loads((out / "checkpoint.json").read_text())["state"]["evaluations"]
    resumed = run_synthesis(read_synthesis(file), workers=1, output=out, resume=True, evaluations=reached + 30)
    whole = run_synthesis(read_synthesis(file), workers=1, evaluations=reached + 30)
    assert resumed.search.state.population == whole.search.state.population
    assert resumed.search.state.history == whole.search.state.history
