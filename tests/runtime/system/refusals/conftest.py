"""Fixtures of tests of refusals: the command in this process, and one flavour of the tiny FMUs."""

import pytest

from perilune.analysis.cli import main
from tests.support.refused import ONE_LINE


@pytest.fixture
def refused(tmp_path, capfd, monkeypatch):
    """Run `perilune run PATH --output ...` in this process and check the form of the refusal."""
    monkeypatch.chdir(tmp_path)

    def check(path, *words, options=(), status=2, verb=("run",)):
        before = sorted(tmp_path.rglob("*"))
        written = () if verb != ("run",) else ("--output", str(tmp_path / "out" / "flight.csv"))
        code = main([*verb, str(path), *options, *written])
        output = capfd.readouterr()
        assert code == status, output.err
        match = ONE_LINE.fullmatch(output.err)
        assert match, output.err
        assert status == 1 or "Traceback" not in output.err  # a run that fails shows the FMU's own log
        said = output.err.replace(str(tmp_path), "")  # whose name is that of the test
        for token in words:
            assert token in said, said
        if status == 2:
            assert output.out == ""
            assert sorted(tmp_path.rglob("*")) == before
        return output.err

    return check


@pytest.fixture
def tiny(tiny_folder):
    """Return one flavour, which is enough: nothing here is simulated."""
    return tiny_folder / "python"
