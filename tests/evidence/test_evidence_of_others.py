"""Foreign evidence that names files elsewhere, unknown studies, or too much: one line each, nothing read or written.

Truth: the contents of each manifest.
"""

import hashlib
import zipfile

import pytest

from perilune.analysis.cli import main
from perilune.analysis.evidence.manifest import check_listed, read_manifest
from perilune.fmus_src.evidence.manifest import STUDY, SUMS, Related, add_manifest
from tests.evidence.hostile import OUT, experiment, fmu, manifest
from tests.support.lengths import either

STUDIED = f"<Annotations><Annotation type='{STUDY}'><Study name='/etc/passwd'/></Annotation></Annotations>"
IN = OUT.replace("out", "in")
FED = manifest('<Experiment name="e"><Stimuli source="in.csv"/><References source="out.csv"/></Experiment>')
STILL = "".join(["time,y\n", *(f"{0.1 * n:.1f},0\n" for n in range(11))])
COLUMNS = either(20_000, 2_000)
WIDE = "time," + ",".join(f"c{n}" for n in range(COLUMNS)) + "\n" + "0," * COLUMNS + "0\n"


@pytest.mark.parametrize(
    ("files", "message"),
    [
        (experiment('stepSize="0.1" startTime="5"'), "e: starts at 5 s, but the default experiment starts at 0 s"),
        (experiment("", "../../../etc/passwd"), "contains no trajectory, so there is nothing to reproduce"),
        (experiment("", "file:///etc/passwd"), "contains no trajectory, so there is nothing to reproduce"),
        (experiment("", "//["), "contains no trajectory, so there is nothing to reproduce"),
        (manifest('<Related source="http://[x" role="result" type="text/csv"/>'), "contains no trajectory"),
        (experiment("") | {OUT: "time\n0\n1\n"}, "e: its reference has no signal to compare"),
        (experiment("") | {OUT: "time,y\n0,a\n1,b\n"}, "e: its reference has no signal to compare"),
        (experiment("") | {OUT: "time,y\n-1,0\n1,0\n"}, "e: its reference starts at -1 s, but the simulation at 0 s"),
        (experiment("") | {OUT: "time,y\n0,9007199254740993\n"}, "reference 9007199254740992.0, simulated 0.0"),
        (FED | {OUT: "time,y\n0,0\n", IN: "time,u\n0,a\n"}, "in.csv: column u: has values that are not numbers"),
        (experiment("", "gone.csv"), "gone.csv: file: missing, although an experiment names it"),
        (manifest(f'<Related source="out.csv" role="report">{STUDIED}</Related>'), "reports /etc/passwd, which is no"),
        (manifest('<Related source="/etc/passwd" role="result" type="text/csv"/>'), "contains no trajectory"),
        (experiment("") | {OUT: WIDE}, f"e: and {COLUMNS - 6} more columns"),
        (experiment("") | {OUT: "time,\x1b[2Jy\n0,0\n"}, "e: column \\x1b[2Jy: no such variable"),
        (experiment("") | {OUT: "time,y\n0,1e400\n1,nan\n"}, "e: y differs by ∞ at t = 0 s"),
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


def test_files_that_are_listed_often_are_digested_once(tiny_folder, tmp_path, capsys):
    """20 000 times 50 MB, and as many flaws: a line each of the file and of the flaw."""
    listed = '<Related source="../../x.bin" role="resutl" checksum="00"/>' * 20_000
    fmu(manifest(listed) | {"x.bin": bytes(50_000_000)})(tmp_path, tiny_folder / "native")
    assert main(["verify", str(tmp_path / "x.fmu")]) == 1
    captured = capsys.readouterr()
    assert captured.err.count("x.bin: changed: its SHA3-256 checksum differs from the manifest") == 1
    assert captured.out.count("role 'resutl' is not defined by the standard") == 1


def test_names_are_those_of_uris(tiny_folder, tmp_path, capsys):
    """By RFC 3986: percent-encoded, a fragment does not belong to the path."""
    files = experiment("", "a%20b%2520c.csv#rows") | {OUT.replace("out", "a b%20c"): STILL}
    fmu(files)(tmp_path, tiny_folder / "native")
    assert main(["verify", str(tmp_path / "x.fmu")]) == 0
    assert "e: a b%20c.csv: 11 samples of 1 signals: the same bits" in capsys.readouterr().out


@pytest.mark.parametrize("line", ["{}  modelDescription.xml\r\n", "{} *modelDescription.xml\n"])
def test_sums_of_windows_and_of_binary_mode(tiny_folder, tmp_path, capsys, line):
    """As `sha256sum --binary` writes them, and with the ends of lines of Windows."""
    files = experiment("") | {OUT: STILL}
    fmu(files)(tmp_path, tiny_folder / "native")
    with zipfile.ZipFile(tmp_path / "x.fmu") as archive:
        digest = hashlib.sha256(archive.read("modelDescription.xml")).hexdigest()
    fmu(files | {SUMS: line.format(digest)})(tmp_path, tiny_folder / "native")
    assert main(["verify", str(tmp_path / "x.fmu")]) == 0
    fmu(files | {SUMS: line.format("0" * 64)})(tmp_path, tiny_folder / "native")
    assert main(["verify", str(tmp_path / "x.fmu")]) == 1
    assert "modelDescription.xml: changed: its SHA-256 differs from SHA256SUMS" in capsys.readouterr().err


def test_flaws_are_notes(tiny_folder, tmp_path, capsys):
    first, second = '<Related source="out.csv" role="resutl"/>', '<Related role="other"/>'
    third = '<Related source="out.csv" role="other" checksum="00" checksumType="MD5"/>'
    fmu(manifest(first + second + third))(tmp_path, tiny_folder / "native")
    assert main(["verify", str(tmp_path / "x.fmu")]) == 1
    out = " ".join(capsys.readouterr().out.split())
    assert "note: manifest: Related (line 1): role 'resutl' is not defined by the standard" in out
    assert "note: manifest: Related (line 1): no attribute source" in out
    assert (
        "note: manifest: Related (line 1): checksumType 'MD5' is not defined by the standard; the checksum was not"
        in out
    )


@pytest.mark.parametrize("name", ["extra/x/a b%20c#d?.toml", "extra/x/ä:1.toml"])
def test_any_name_is_listed_as_a_uri(name):
    files = add_manifest({name: b""}, [Related(name, "other", "text/plain", "")])
    listed = read_manifest(files, "x")
    assert [related.name for related in listed.files] == [name, SUMS]
    assert check_listed(listed, files) == {}
