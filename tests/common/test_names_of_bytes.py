"""Names that are not UTF-8 are refused in one line at any place, before any simulation.

Truth: the bytes of the name, and an empty folder afterwards.
"""

import io
import os
import subprocess
import sys

import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common.errors import InputError
from perilune.common.paths import shipped_fmu
from perilune.common.process import Stream

NAME = os.fsdecode(b"n\xff")
SYSTEM = "lunar_terminal_guidance"


@pytest.mark.parametrize(
    "command",
    [
        ["run", SYSTEM, "--output", f"{NAME}.csv"],
        ["run", SYSTEM, "--report", f"{NAME}.html"],
        ["run", SYSTEM, "--json", f"{NAME}/x.json"],
        ["batch", SYSTEM, "--campaign", "paper", "--output", NAME],
        ["export", "flat_moon_lander", "--output", f"{NAME}.fmu"],
        ["verify", f"{NAME}.fmu"],
    ],
)
def test_refused_in_one_line(tmp_path, monkeypatch, capsys, command):
    monkeypatch.chdir(tmp_path)
    assert main(command) == 2
    error = capsys.readouterr().err
    assert error.startswith(f"perilune: {command[0]}: n\\udcff")
    assert "not UTF-8; give a path" in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", [NAME, f"{NAME}/results"])
def test_in_python_too(tmp_path, name):
    with pytest.raises(InputError, match=r"output: .*not UTF-8"):
        perilune.batch(SYSTEM, "paper", trials=2, output=tmp_path / name)


def test_a_working_folder(tmp_path, monkeypatch, capsys, refusal):
    (tmp_path / NAME).mkdir()
    monkeypatch.chdir(tmp_path / NAME)
    assert main(["run", SYSTEM]) == 2
    assert capsys.readouterr().err.startswith("perilune: working folder: ")
    (tmp_path / NAME).rmdir()
    if sys.platform == "linux":
        assert "No such file or directory; change to an existing folder" in refusal(["run", SYSTEM])


def test_what_a_terminal_cannot_show_is_escaped():
    raw = io.BytesIO()
    stream = Stream(io.TextIOWrapper(raw, encoding="ascii"))
    stream.write(f"{NAME} \u221e\n")
    stream.flush()
    assert raw.getvalue() == b"n\\udcff \\u221e\n"


@pytest.mark.usefixtures("fmus")
@pytest.mark.skipif(sys.platform == "win32", reason="a limit of POSIX")
def test_a_limit_of_file_sizes_is_named(tmp_path):
    """SIGXFSZ ends nothing: the file that is too large is named, and what to do."""
    limit = shipped_fmu("noisy_navigation", "native").stat().st_size - 1  # enough for the library inside
    script = (
        f"import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))\n"
        "from perilune.analysis.cli import run; run()"
    )
    command = ["batch", SYSTEM, "--campaign", "paper", "--trials", "2", "--output", "out"]
    done = subprocess.run(
        [sys.executable, "-c", script, *command], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 2, done.stderr
    line = done.stderr.splitlines()[-1]  # behind one on the cache, where a function was compiled
    assert line.startswith(f"perilune: {tmp_path / 'out'}")
    assert "File too large; raise the limit on file size (ulimit -f)" in line
    assert "space" not in done.stderr
