"""Evidence of others that names files elsewhere, other studies, or very much: a line each, nothing read or written.

Truth: what each manifest says.
"""

import pytest

from perilune.analysis.cli import main
from perilune.fmus_src.evidence.manifest import STUDY
from tests.evidence.hostile import OUT, experiment, fmu, manifest

STUDIED = f"<Annotations><Annotation type='{STUDY}'><Study name='/etc/passwd'/></Annotation></Annotations>"
WIDE = "time," + ",".join(f"c{n}" for n in range(20_000)) + "\n" + "0," * 20_000 + "0\n"


@pytest.mark.parametrize(
    ("files", "message"),
    [
        (experiment('stepSize="1e-300"'), "e: "),
        (experiment('stepSize="0.1" startTime="5"'), "e: starts at 5 s, where the default experiment starts at 0 s"),
        (experiment("", "../../../etc/passwd"), "holds no trajectory: nothing to reproduce"),
        (experiment("", "file:///etc/passwd"), "holds no trajectory: nothing to reproduce"),
        (experiment("", "gone.csv"), "gone.csv: file: missing, though an experiment names it"),
        (manifest(f'<Related source="out.csv" role="report">{STUDIED}</Related>'), "reports /etc/passwd, which is no"),
        (manifest('<Related source="/etc/passwd" role="result" type="text/csv"/>'), "holds no trajectory"),
        (experiment("") | {OUT: WIDE}, "e: and 19994 more columns"),
        (experiment("") | {OUT: "time,\x1b[2Jy\n0,0\n"}, "e: column \\x1b[2Jy: no such variable"),
        (experiment("") | {OUT: "time,y\n0,1e400\n1,nan\n"}, "e: y differs by ∞ at t = 0 s"),
        (experiment("") | {OUT: "time,y\n0,0\n1e300,0\n"}, "e: "),
    ],
)
def test_a_line_for_what_it_asks(tiny_folder, tmp_path, capsys, files, message):
    fmu(files)(tmp_path, tiny_folder / "native")
    before = sorted(tmp_path.rglob("*"))
    assert main(["verify", str(tmp_path / "x.fmu")]) == 1
    errors = capsys.readouterr().err
    assert message in errors
    assert "\x1b" not in errors
    assert errors.count("\n") < 10
    assert sorted(tmp_path.rglob("*")) == before


def test_flaws_are_notes(tiny_folder, tmp_path, capsys):
    first, second = '<Related source="out.csv" role="resutl"/>', '<Related role="other"/>'
    third = '<Related source="out.csv" role="other" checksum="00" checksumType="MD5"/>'
    fmu(manifest(first + second + third))(tmp_path, tiny_folder / "native")
    assert main(["verify", str(tmp_path / "x.fmu")]) == 1
    out = " ".join(capsys.readouterr().out.split())
    assert "note: manifest: Related (line 1): role 'resutl' is none of the standard" in out
    assert "note: manifest: Related (line 1): no attribute source" in out
    assert "note: manifest: Related (line 1): checksumType 'MD5' is none of the standard: not checked" in out
