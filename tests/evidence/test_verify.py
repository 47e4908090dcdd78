"""`perilune verify`: unchanged deliveries pass, and one changed bit is reported with its signal and time.

Truth: FMUs with one change by the test; trajectories simulated by FMPy.
"""

import csv
import io
import json
import re
import zipfile

import fmpy
import pytest

from perilune.analysis.cli import main
from perilune.common.paths import shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.evidence.manifest import FOLDER, MANIFEST, SUMS
from tests.support.builders import write_zip
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
NAME = "flat_moon_lander"
CHECK, OUTPUTS = f"{FOLDER}/check.csv", f"{FOLDER}/outputs.csv"


@pytest.fixture
def files():
    with zipfile.ZipFile(shipped_fmu(NAME, "native")) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def refused(tmp_path, files, capsys, *options):
    """Return the lines on standard error for an FMU of these files, exit status 1."""
    path = write_zip(tmp_path / "x.fmu", files)
    assert main(["verify", str(path), *options]) == 1
    return capsys.readouterr().err.replace(f"perilune: {path}: ", "").splitlines()


def changed(table, column, row, change):
    """Return a CSV with one number changed."""
    rows = list(csv.reader(io.StringIO(table.decode())))
    index = rows[0].index(column)
    rows[row + 1][index] = repr(change(float(rows[row + 1][index])))
    return "\n".join([*map(",".join, rows), ""]).encode()


def without_digests(files):
    """Return the same FMU with a manifest that has no digests, as others write it."""
    manifest = re.sub(rb' checksum="\w+" checksumType="[\w-]+"', b"", files[MANIFEST])
    manifest = re.sub(rb"\s*<Related[^>]*SHA256SUMS[^>]*>", b"", manifest)
    return {name: content for name, content in files.items() if name != SUMS} | {MANIFEST: manifest}


def test_ours_are_verified(capsys):
    assert main(["verify", "orbital_filter", str(shipped_fmu(NAME, "python")), "kalman_navigation_filterpy"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert captured.out.count(": verified\n") == 3
    assert captured.out.count("outputs.csv") == captured.out.count("the same bits") == 2
    assert re.search(
        r"flat_moon_lander.fmu: check: check.csv: 33 samples of 7 signals: differ by at most 0\.\d+", captured.out
    )


def test_every_fmu_of_ours(capsys):
    """Verify FMUs of either flavour, in `make long` all of them."""
    paths = [
        shipped_fmu(name, flavour)
        for flavour, step in (("native", either(1, 8)), ("python", either(1, 24)))
        for name in sorted(catalogue())[::step]
        if shipped_fmu(name, flavour).exists()
    ]
    assert main(["verify", *map(str, paths)]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert captured.out.count(": verified\n") == len(paths) > either(len(catalogue()), 12)


def test_as_json(capsys):
    assert main(["verify", NAME, "--json", "-"]) == 0
    (actual,) = json.loads(capsys.readouterr().out)
    assert actual["verified"]
    assert [created["name"] for created in actual["reproductions"]] == ["check", "outputs"]
    assert all(signal["difference"] == 0.0 for signal in actual["reproductions"][1]["signals"])


def test_one_changed_bit_of_a_trajectory(tmp_path, files, capsys):
    """In a file with a digest the file is named, in any the signal and the time."""
    files[OUTPUTS] = changed(files[OUTPUTS], "position[3]", 12, lambda number: number * (1.0 + 2.0**-52))
    assert main(["verify", str(write_zip(tmp_path / "x.fmu", files))]) == 1
    assert f"{OUTPUTS}: changed: its SHA-256 differs from SHA256SUMS" in capsys.readouterr().err
    (line,) = refused(tmp_path, without_digests(files), capsys)
    assert re.match(r"outputs: position\[3\] differs by \d\.?\d*e-12 at t = 1.5 s: reference ", line)
    assert line.endswith("; the same bits required")
    path = write_zip(tmp_path / "x.fmu", without_digests(files))
    assert main(["verify", str(path), "--tolerance", "1e-12"]) == 0


def test_one_changed_bit_of_a_library(tmp_path, files, capsys):
    (name,) = (name for name in files if name.startswith("binaries/linux64/"))
    library = bytearray(files[name])
    library[-1] ^= 1  # of the section headers, which nothing reads
    lines = refused(tmp_path, files | {name: bytes(library)}, capsys)
    assert f"{name}: changed: its SHA-256 differs from SHA256SUMS" in lines


def test_swapped_columns(tmp_path, files, capsys):
    header, rows = files[CHECK].split(b"\n", 1)
    swapped = header.replace(b"position[1]", b"?").replace(b"position[2]", b"position[1]").replace(b"?", b"position[2]")
    lines = refused(tmp_path, without_digests(files) | {CHECK: swapped + b"\n" + rows}, capsys)
    assert len(lines) == 2
    assert all(re.match(r"check: position\[[12]\] differs by 120000 at t = 0 s: ", line) for line in lines), lines


def test_a_missing_file(tmp_path, files, capsys):
    lines = refused(tmp_path, {name: text for name, text in files.items() if name != OUTPUTS}, capsys)
    assert lines[0] == f"{OUTPUTS}: missing, though SHA256SUMS lists it"
    assert "outputs: " in lines[1]
    assert "missing, although an experiment names it; export the file again" in lines[1]
    lines = refused(tmp_path, {name: text for name, text in files.items() if name != "sources/kernel_math.h"}, capsys)
    assert lines == ["sources/kernel_math.h: missing, though SHA256SUMS lists it"]


def test_an_added_file_is_noted(tmp_path, files, capsys):
    path = write_zip(tmp_path / "x.fmu", files | {"binaries/darwin64/flat_moon_lander.dylib": b""})
    assert main(["verify", str(path)]) == 0
    assert "note: binaries/darwin64/flat_moon_lander.dylib: not in SHA256SUMS, so it was added later" in " ".join(
        capsys.readouterr().out.split()
    )


def test_a_changed_model(tmp_path, files, capsys):
    """Another parameter than that of the trajectory."""
    name = f"{FOLDER}/check.ssv"
    files = without_digests(files) | {name: files[name].replace(b'"-40.0"', b'"-40.1"')}
    lines = refused(tmp_path, files, capsys)
    assert any(re.match(r"outputs: velocity\[3\] differs by ", line) for line in lines)


OTHERS = b"""<?xml version="1.0"?>
<fmiReferences xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest"
    fmi-ls:fmi-ls-name="org.fmi-standard.fmi-ls-ref" fmi-ls:fmi-ls-version="1.0.0-alpha.1">
  <Related type="text/csv" source="out.csv" role="result" description="Output of the default experiment"/>
</fmiReferences>
"""


def test_a_manifest_as_reference_fmus_have_it(tmp_path, files, capsys):
    """A result of the default experiment, without the description that the schema requires. Truth: FMPy."""
    bare = {name: content for name, content in files.items() if not name.startswith("extra/")}
    fmu = write_zip(tmp_path / "bare.fmu", bare)
    simulated = fmpy.simulate_fmu(str(fmu), stop_time=2.0, step_size=0.1, output_interval=0.2)
    names = simulated.dtype.names
    table = "\n".join([",".join(names), *(",".join(map(repr, map(float, row))) for row in simulated), ""]).encode()
    path = write_zip(tmp_path / "x.fmu", bare | {MANIFEST: OTHERS, f"{FOLDER}/out.csv": table})
    assert main(["verify", str(path)]) == 0
    out = capsys.readouterr().out
    assert "note: manifest: line 3: no attribute fmi-ls-description" in " ".join(out.split())
    assert re.search(r"default experiment: out.csv: 11 samples of \d+ signals: ", out)
    wrong = changed(table, "position[3]", 4, lambda number: number + 0.02)
    (line,) = refused(tmp_path, bare | {MANIFEST: OTHERS, f"{FOLDER}/out.csv": wrong}, capsys)
    assert re.match(r"default experiment: position\[3\] differs by 0.02 at t = 0.8 s: .*; 0.0105 permitted", line)


@pytest.mark.parametrize("form", ["attributes", "manifest"])
def test_experiments_as_they_were_written_earlier(tmp_path, files, capsys, form):
    """Times as attributes of the experiment (2025), and experiments in the manifest itself."""
    experiment = b"""<Experiment name="old" startTime="0.0" stopTime="4.0" stepSize="0.125">
      <Parameters source="check.ssv"/><Stimuli source="check.csv"/><References source="outputs.csv"/></Experiment>"""
    files = without_digests(files)
    if form == "manifest":
        files[MANIFEST] = re.sub(rb"<Related.*/>", experiment, files[MANIFEST], flags=re.DOTALL)
    else:
        files[f"{FOLDER}/check.exp"] = b"<Experiments>" + experiment + b"</Experiments>"
    assert main(["verify", str(write_zip(tmp_path / "x.fmu", files))]) == 0
    assert "old: outputs.csv: 33 samples of 7 signals: the same bits" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("manifest", "message"),
    [
        (None, f"evidence: contains no {MANIFEST}, so there is nothing to verify; export it with Perilune"),
        (b"<a", "not well-formed XML"),
        (b"<!DOCTYPE a><a/>", "DOCTYPE"),
        (b"<manifest/>", "manifest: the root element is not fmiReferences"),
        (OTHERS.replace(b"fmi-ls-ref", b"fmi-ls-bus"), "'org.fmi-standard.fmi-ls-bus' is a different layered standard"),
    ],
)
def test_without_a_manifest_that_is_one(tmp_path, files, capsys, manifest, message):
    files = {name: content for name, content in files.items() if name != MANIFEST}
    path = write_zip(tmp_path / "x.fmu", files | ({} if manifest is None else {MANIFEST: manifest}))
    assert main(["verify", str(path)]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.err.count("\n") == 1


@pytest.mark.parametrize(
    ("name", "content", "status", "message"),
    [
        (OUTPUTS, b"", 1, "not a table"),
        (OUTPUTS, b"time,a\n1.0,2.0\n0.5,1.0\n", 1, "0.5 s in row 2 is before the time of the preceding row"),
        (OUTPUTS, b"t,a\n1.0,2.0\n", 1, "time: no such column"),
        (OUTPUTS, b"time,nothing\n0.0,2.0\n", 1, "column nothing: no such variable"),
        (f"{FOLDER}/check.ssv", b"<a/>", 1, "not valid SSP"),
        (f"{FOLDER}/check.exp", b"<a/>", 2, "a: the root element is not Experiments"),
    ],
)
def test_evidence_that_cannot_be_read(tmp_path, files, capsys, name, content, status, message):
    path = write_zip(tmp_path / "x.fmu", without_digests(files) | {name: content})
    assert main(["verify", str(path)]) == status
    assert message in capsys.readouterr().err


def test_a_suffix_in_capitals(tmp_path, files, capsys):
    assert main(["verify", str(write_zip(tmp_path / "X.FMU", files))]) == 0
    assert main(["verify", str(tmp_path / "X.SSP")]) == 2
    assert "X.SSP: " in (message := capsys.readouterr().err)
    assert "that is built" not in message


def test_what_is_no_file_of_these(tmp_path, refusal):
    assert "perilune export lunar_terminal_guidance writes it with its evidence" in refusal(
        ["verify", "lunar_terminal_guidance"]
    )
    assert "the nearest of" in refusal(["verify", "orbital_filtre"])
