"""Evidence in an exported FMU: manifest, digests, page, and a user's check.

Truth: sha256sum and hashlib over the archive's files, the declaration of the block, one simulation by hand.
"""

import hashlib
import posixpath
import subprocess
import zipfile

import pytest
from fmpy import read_model_description
from lxml import etree

from perilune.analysis.cli import main
from perilune.analysis.evidence.manifest import read_manifest
from perilune.common.paths import shipped_fmu
from perilune.fmus_src.catalogue import blocks_in_file
from perilune.fmus_src.evidence.check import CheckError, read_check
from perilune.fmus_src.evidence.manifest import FOLDER, MANIFEST, SUMS
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from tests.support.pages.narrow import measure

ADDER = '''
from perilune import Block, Input, Output, Parameter


class Adder(Block):
    """Adds its input times a gain, once a step.

        y_next = y + gain u

    The `gain` is constant.

    Source: none.
    """

    gain = Parameter(2.0, description="gain < 3 & more")
    u = Input(0.0, description="what is added")
    flag = Input(False, description="whether it is")
    y = Output(0.0, description="sum")
    count = Output(0, description="steps")

    def initialize(self) -> None:
        self.y = self.u

    def step(self, t: float, h: float) -> None:
        if self.flag:
            self.y = self.y + self.gain * self.u
        self.count = self.count + 1
'''
CSV = b"time,u,flag,y,count\n0.0,0.5,1.0,0.5,0.0\n0.25,-1.0,0.0,2.0,1.0\n0.5,0.0,0.0,2.0,2.0\n"
TOML = b"""truth = "by hand"
step_size = 0.25
stop_time = 0.5
[parameters]
gain = 3
[tolerances]
y = { absolute = 1e-12, relative = 0.0 }
count = { absolute = 0.0, relative = 0.0 }
"""


@pytest.fixture
def adder(tmp_path):
    (tmp_path / "adder.py").write_text(ADDER)
    (tmp_path / "checks").mkdir()
    (tmp_path / "checks" / "adder.csv").write_bytes(CSV)
    (tmp_path / "checks" / "adder.toml").write_bytes(TOML)
    (block,) = blocks_in_file(tmp_path / "adder.py")
    return block


def files_of(path):
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.mark.parametrize("flavour", ["native", "python"])
def test_digests_of_all_files(fmus, flavour, tmp_path):
    files = files_of(shipped_fmu("orbital_filter", flavour))
    with zipfile.ZipFile(shipped_fmu("orbital_filter", flavour)) as archive:
        archive.extractall(tmp_path)
    done = subprocess.run(["sha256sum", "--check", "--strict", SUMS], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0
    assert done.stdout.count(": OK") == len(files) - 2
    root = etree.fromstring(files[MANIFEST])
    roles = {}
    for related in root.iterfind("Related"):
        name = posixpath.normpath(posixpath.join(FOLDER, related.get("source")))
        assert related.get("checksum") == hashlib.new("sha3_256", files[name]).hexdigest()
        roles[posixpath.basename(name)] = related.get("role")
    assert roles == {
        "index.html": "document",
        "check.csv": "result",
        "check.ssv": "parameter",
        "outputs.csv": "result",
        "check.exp": "experiment/validation",
        "SHA256SUMS": "meta-data",
    }
    assert read_manifest(files, "x").flaws == ()


def test_the_evidence_of_a_users_block(adder, tmp_path):
    """Parameters take the block's types, outputs are those by hand, the GUID is that without evidence."""
    files = files_of(build_python_fmu(adder, tmp_path / "adder.fmu"))
    assert files[f"{FOLDER}/check.csv"] == CSV
    assert files[f"{FOLDER}/outputs.csv"] == b"time,y,count\n0.0,0.5,0\n0.25,2.0,1\n0.5,2.0,2\n"
    (gain,) = etree.fromstring(files[f"{FOLDER}/check.ssv"]).findall(".//{*}Parameter")
    assert (gain.get("name"), etree.QName(gain[0]).localname, gain[0].get("value")) == ("gain", "Real", "3.0")
    guid = read_model_description(tmp_path / "adder.fmu").guid
    for path in (tmp_path / "checks").iterdir():
        path.unlink()
    assert read_check(adder) is None
    without = build_python_fmu(adder, tmp_path / "adder.fmu")
    assert read_model_description(without).guid == guid
    assert set(files) - set(files_of(without)) == {
        f"{FOLDER}/{name}" for name in ("check.csv", "check.ssv", "check.exp", "outputs.csv")
    }


def test_the_page_of_a_block(adder, tmp_path):
    files = files_of(build_python_fmu(adder, tmp_path / "adder.fmu"))
    page = etree.HTML(files["documentation/index.html"].decode())
    assert page.xpath("string(//h1)") == "adder"
    assert page.xpath("string(//pre)") == "y_next = y + gain u"
    assert page.xpath("//p[starts-with(., 'Source')]/text()") == ["Source: none."]
    assert page.xpath("normalize-space(//p[code='gain'])") == "The gain is constant."
    rows = [[cell.text for cell in row] for row in page.iterfind(".//tr")]
    assert ["gain", "Real", "2", "1", "gain < 3 & more"] in rows
    assert ["count", "Integer", None, "steps"] in rows


def test_the_page_of_a_block_fits_a_telephone(browser, adder, tmp_path):
    text = files_of(build_python_fmu(adder, tmp_path / "adder.fmu"))["documentation/index.html"].decode()
    assert 'name="viewport"' in text
    assert "color-scheme: light dark" in text
    (tmp_path / "page.html").write_text(text.replace("what is added", "added_" * 40), encoding="utf-8")
    assert {each.overflow for each in measure(browser, tmp_path / "page.html", tmp_path)} == {0}


@pytest.mark.parametrize(
    ("file", "before", "after", "message"),
    [
        ("adder.csv", b"time,u", b"t,u", "adder.csv: line 1: the first column is not time"),
        ("adder.csv", b"flag", b"flags", "adder.csv: column flags: neither an input nor an output"),
        ("adder.csv", b"2.0,2.0\n", b"2.0,x\n", "adder.csv: not a table of numbers"),
        ("adder.csv", b"2.0,2.0\n", b"2.0\n", "adder.csv: not a table of numbers"),
        ("adder.toml", b"gain", b"gains", "adder.toml: parameters.gains: no such parameter"),
        ("adder.toml", b"count =", b"z =", "adder.toml: tolerances.z: adder.csv has no such column"),
        ("adder.toml", b"absolute = 1e-12, ", b"", "adder.toml: tolerances.y: write"),
        ("adder.toml", b"step_size = 0.25", b"", "adder.toml: step_size: missing"),
        ("adder.toml", b"step_size = 0.25", b"step_size = 0", "adder.toml: step_size: 0 s; give a positive step"),
        ("adder.toml", b"stop_time = 0.5", b"stop_time = nan", "adder.toml: stop_time: missing, or of another type"),
        ("adder.toml", b"absolute = 1e-12", b"absolute = nan", "adder.toml: tolerances.y: write"),
        ("adder.toml", b"absolute = 1e-12", b"absolute = -1", "adder.toml: tolerances.y: write"),
        ("adder.toml", b"absolute = 1e-12", b"absolute = true", "adder.toml: tolerances.y: write"),
        ("adder.toml", TOML[TOML.index(b"y =") :], b"", "adder.toml: tolerances: no output"),
        ("adder.toml", b"gain = 3", b"gain = true", "adder.toml: parameters.gain: True is not a finite float or int"),
        ("adder.toml", b"gain = 3", b"gain = inf", "adder.toml: parameters.gain: inf is not a finite float or int"),
        ("adder.toml", b"gain = 3", b"gain = {}", "adder.toml: parameters.gain: {} is not a finite float or int"),
        ("adder.csv", b"0.25,", b"0.75,", "adder.csv: row 3, time"),
        ("adder.csv", b"u,flag", b"u,u", "adder.csv: line 1: two columns of the same name"),
        ("adder.csv", CSV[CSV.index(b"0.0") :], b"", "adder.csv: not a table of numbers: no rows"),
        ("adder.csv", CSV, b"", "adder.csv: not a table of numbers"),
        ("adder.py", b"self.gain * self.u", b"1.0 / 0.0", "adder: check: the block raises ZeroDivisionError: float"),
        ("adder.toml", b'truth = "by hand"', b"truth = ", "adder.toml: not TOML"),
    ],
)
def test_a_check_that_does_not_fit_is_refused(adder, tmp_path, monkeypatch, capsys, file, before, after, message):
    path = tmp_path / ("" if file.endswith(".py") else "checks") / file
    path.write_bytes(path.read_bytes().replace(before, after, 1))
    monkeypatch.chdir(tmp_path)
    assert main(["export", "adder.py", "--flavour", "python"]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.err.count("\n") == 1
    assert not (tmp_path / "build").exists()


def test_one_of_the_two_files_alone_is_refused(adder, tmp_path):
    (tmp_path / "checks" / "adder.toml").unlink()
    with pytest.raises(CheckError, match=r"checks/adder\.toml: no such file; a check is a trajectory, .csv, and"):
        read_check(adder)
