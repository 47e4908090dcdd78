"""Hostile files, each read by the commands that accept it: exit status, and one line that names file and element.

Truth: the expectation stated with each file. The peak resident memory is measured by the operating system.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys

import pytest

from perilune.common.paths import ROOT
from perilune.common.visible import CONTROLS
from tests.evidence import hostile as evidence
from tests.hostile import (
    archives,
    arrays,
    campaigns,
    documents,
    expressions,
    fmus,
    folders,
    kinds,
    more_documents,
    systems,
    tables,
    values,
)
from tests.hostile.fmus import SPOOF
from tests.hostile.server import DEADLINE, Server
from tests.support.lengths import either
from tests.support.refused import ONE_LINE

pytestmark = pytest.mark.flies
SUBJECTS = (
    *(archives, arrays, campaigns, documents, evidence, expressions, fmus, folders, kinds, more_documents, systems),
    *(tables, values),
)
CASES = {name: case for subject in SUBJECTS for name, case in subject.CASES.items()}
TRIED = list(CASES)[:: either(1, 8)]  # all of them under `make long`
MEMORY = 420_000_000  # bytes, of which a process without work has 180 million
AS_COMMANDS = (
    "archive: 300 MB of zeros",
    "campaign: of a pipe",
    "draws: 5 x 10^7 rows",
    "description: a billion laughs",
)


@pytest.fixture(scope="module")
def server():
    server = Server(ROOT)
    yield server
    server.close()


def contents(folder):
    """Return every path of a folder."""
    return sorted(folder.rglob("*"))


def check_answer(case, status, output, errors):
    """Check for one line of text, which names the error, and nothing else; of accepted files only their own lines."""
    assert not CONTROLS.search(output + errors)
    if case.accepted:
        assert status == 0, errors[-2000:]
        assert not re.search(rf"^{SPOOF}", output + errors, re.MULTILINE)
        return
    assert status == case.status, (status, errors[-2000:])
    assert ONE_LINE.fullmatch(errors), errors[:2000]
    assert len(errors) < 4100
    for phrase in case.words:
        assert phrase in errors, errors
    assert output == ""


def test_there_are_enough():
    assert len(TRIED) >= either(400, 70)
    assert len(CASES) == sum(len(subject.CASES) for subject in SUBJECTS)  # no name twice


@pytest.mark.parametrize("name", TRIED)
def test_answer(server, tiny_folder, tmp_path, name):
    case = CASES[name]
    folder, temporary = tmp_path / "work", tmp_path / "temporary"
    folder.mkdir()
    temporary.mkdir()
    case.write(folder, tiny_folder / "native")
    before = contents(folder)
    for command in case.commands:
        outcome = server.carry_out(shlex.split(command), folder, temporary)
        check_answer(case, outcome.status, outcome.output, outcome.errors)
        assert outcome.memory < MEMORY
        assert contents(folder) == before
        assert contents(temporary) == []


@pytest.mark.parametrize("name", AS_COMMANDS)
def test_answer_of_a_command(tiny_folder, tmp_path, name):
    case = CASES[name]
    case.write(tmp_path, tiny_folder / "native")
    result = subprocess.run(
        [sys.executable, "-m", "perilune", *shlex.split(case.commands[-1])],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=DEADLINE,
        check=False,
    )
    check_answer(case, result.returncode, result.stdout, result.stderr)
