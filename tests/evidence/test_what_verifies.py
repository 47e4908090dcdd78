"""Evidence beyond the limits of resources is refused, and incomplete evidence is compared, not verified.

Truth: an exported FMU with one number of its evidence changed by the test.
"""

import json
import re

import numpy as np
import pytest

from perilune.analysis.cli import main
from perilune.analysis.evidence.reference_comparison import compare_signal
from perilune.fmus_src.evidence.manifest import FOLDER
from tests.evidence.hostile import OUT, experiment, fmu
from tests.evidence.test_evidence_of_others import STILL
from tests.evidence.test_verify import CHECK, files, without_digests
from tests.support.builders import write_zip

__all__ = ["files"]  # the fixture
pytestmark = pytest.mark.usefixtures("fmus")
EXPERIMENTS = f"{FOLDER}/check.exp"


def changed(tmp_path, files, pattern, text):
    """Return the FMU with other experiments."""
    experiments = re.sub(pattern.encode(), text.encode(), files[EXPERIMENTS])
    assert experiments != files[EXPERIMENTS]
    return write_zip(tmp_path / "x.fmu", without_digests(files) | {EXPERIMENTS: experiments})


@pytest.mark.parametrize(("step", "fraction"), [("1e-6", "1e-9"), ("1e-12", "0.25"), ("1e-300", "0.25")])
def test_steps_too_many_for_the_memory_are_refused_in_one_line(tmp_path, files, capsys, monkeypatch, step, fraction):
    monkeypatch.setenv("PERILUNE_MEMORY_FRACTION", fraction)
    path = changed(tmp_path, files, 'stepSize="[^"]*"', f'stepSize="{step}"')
    assert main(["verify", str(path)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"perilune: {path}: experiment check: ")
    assert line.endswith("give a longer step or an earlier stop time, or set PERILUNE_MEMORY_FRACTION")


@pytest.mark.parametrize("more", [experiment('stepSize="1e-300"'), experiment("") | {OUT: "time,y\n0,0\n1e300,0\n"}])
def test_steps_too_many_for_any_memory(tiny_folder, tmp_path, more, refusal):
    fmu(more)(tmp_path, tiny_folder / "native")
    assert "x.fmu: experiment e: 1e+30" in refusal(["verify", str(tmp_path / "x.fmu")])


def test_the_size_of_tolerances_is_printed(tmp_path, files, capsys):
    """Absolute 1 m of at most 120 km, and those of the outputs to the last bit."""
    path = changed(tmp_path, files, r'"position\[1\]" absolute="[^"]*" relative="[^"]*"',
                   '"position[1]" absolute="1.0" relative="0.0"')  # fmt: skip
    largest = max(abs(float(row.split(b",")[files[CHECK].split(b"\n")[0].split(b",").index(b"position[1]")]))
                  for row in files[CHECK].split(b"\n")[1:-1])  # fmt: skip
    assert main(["verify", str(path)]) == 0
    check, outputs, last = capsys.readouterr().out.splitlines()
    printed = re.search(r"; tolerance up to (\S+) of the greatest magnitude, position\[1\]$", check)
    assert float(printed[1]) == pytest.approx(1.0 / largest, rel=0.05)
    assert outputs.endswith("the same bits; tolerance 0")
    assert last.endswith(": verified")


def test_a_tolerance_that_permits_anything_verifies_nothing(tmp_path, files, capsys):
    path = changed(tmp_path, files, r'"velocity\[3\]" absolute="[^"]*"', '"velocity[3]" absolute="1000.0"')
    assert main(["verify", str(path)]) == 1
    captured = capsys.readouterr()
    (line,) = captured.err.splitlines()
    assert line.startswith(f"perilune: {path}: check: compared, not verified: velocity[3] may differ by ")
    assert captured.out.splitlines()[-1] == f"{path}: compared"
    assert main(["verify", str(path), "--json", "-"]) == 1
    (document,) = json.loads(capsys.readouterr().out)
    assert (document["verified"], document["verdict"]) == (False, "compared")


def test_so_does_one_that_is_given(tiny_folder, tmp_path, capsys):
    fmu(experiment("") | {OUT: STILL})(tmp_path, tiny_folder / "native")
    command = ["verify", str(tmp_path / "x.fmu"), "--tolerance"]
    assert [main([*command, tolerance]) for tolerance in ("0.01", "0.011")] == [0, 1]
    assert "y may differ by 0.011 of its greatest magnitude, more than the permitted 0.01;" in capsys.readouterr().err


def test_nine_samples_verify_nothing(tiny_folder, tmp_path, capsys):
    """A sample that occurs twice is one."""
    rows = STILL.splitlines(keepends=True)
    for table, status in (("".join(rows[:10] + rows[9:10]), 1), ("".join(rows[:11]), 0)):
        fmu(experiment("") | {OUT: table})(tmp_path, tiny_folder / "native")
        assert main(["verify", str(tmp_path / "x.fmu")]) == status
    assert "x.fmu: e: compared, not verified: the reference has 9 samples, but" in capsys.readouterr().err


def test_a_tolerance_is_relative_to_the_greatest_magnitude():
    """A signal through zero, one that is zero, and the finite samples."""
    time = np.linspace(0.0, 1.0, 5)
    for reference, tolerance in (
        (np.array([0.0, 2.0, 0.0, -4.0, 0.0]), 1e-3 / 4.0),
        (np.zeros(5), 1e-3 / 1e-6),
        (np.array([0.0, np.nan, 1.0, np.inf, 0.5]), 1e-3),
    ):
        check = compare_signal("y", time, reference, reference, np.full(5, 1e-3))
        assert check.tolerance == pytest.approx(tolerance)
    assert compare_signal("y", time, time, time, None).tolerance == 0.0
