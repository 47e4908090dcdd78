"""Evidence of a system: its simulation, campaigns, parameter sets, reports; and `perilune verify` of it.

Truth: files changed by the test; a run and a batch of the same system by their verbs.
"""

import json
import shutil
import zipfile

import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.evidence.manifest import read_manifest
from perilune.analysis.evidence.trajectory import read_trajectory
from perilune.common.paths import SYSTEMS
from perilune.fmus_src.evidence.manifest import FOLDER, SUMS
from tests.support.builders import component, connection, document, system, write_zip
from tests.support.lengths import either

FEW = """
extends = "paper.toml"
trials = 3
compare = { guidance = ["analytic_guidance"] }
"""


@pytest.fixture(scope="module")
def exported(fmus, tmp_path_factory):
    """Export a system of a folder with a short campaign, with its report; return its files."""
    folder = tmp_path_factory.mktemp("evidence")
    original = shutil.copytree(SYSTEMS / "lunar_terminal_guidance", folder / "lunar_terminal_guidance")
    (original / "campaigns" / "few.toml").write_text(FEW)
    (original / "documentation").mkdir()
    (original / "documentation" / "moon.svg").write_text("<svg/>")
    perilune.export(original, studies=["few"], output=folder / "landing.ssp")
    with zipfile.ZipFile(folder / "landing.ssp") as archive:
        return folder / "landing.ssp", {name: archive.read(name) for name in archive.namelist()}


def refused(tmp_path, files, capsys):
    path = write_zip(tmp_path / "x.ssp", files)
    assert main(["verify", str(path)]) == 1
    return capsys.readouterr().err.replace(f"perilune: {path}: ", "").splitlines()


def test_its_roles(exported):
    files = exported[1]
    manifest = read_manifest(files, "x")
    assert manifest.flaws == ()
    types = {related.name: related.type for related in manifest.files}
    assert types["documentation/README.md"] == "text/markdown"
    assert types["documentation/moon.svg"] == "image/svg+xml"
    roles = {related.name: related.role for related in manifest.files}
    assert roles["resources/paper.ssv"] == "parameter"
    assert roles["extra/org.perilune/campaigns/few.toml"] == "experiment/uncertainty-analysis"
    assert roles["documentation/README.md"] == "document"
    assert roles[f"{FOLDER}/reports/few.json"] == "report"
    assert set(roles) <= set(files)


def test_its_trajectory_is_that_of_a_run(exported):
    path, files = exported
    stored = read_trajectory(files[f"{FOLDER}/outputs.csv"], "x")
    run = perilune.simulate(path)
    assert stored.time.size == 200
    assert stored.time[[0, -1]].tolist() == run.time[[0, -1]].tolist()
    rows = [run.time.tolist().index(time) for time in stored.time]
    assert {"plant.position[1]", "guidance.status", "finished"} <= set(stored.signals)
    for name, samples in stored.signals.items():
        assert samples.tolist() == run[name][rows].tolist()


def test_its_report_is_that_of_a_batch(exported):
    path, files = exported
    report = json.loads(files[f"{FOLDER}/reports/few.json"])
    batch = perilune.batch(path, "few").to_json()
    assert report["variants"] == batch["variants"]
    assert (report["trials"], report["seed"]) == (3, batch["seed"])


def test_it_is_verified(exported, capsys):
    assert main(["verify", str(exported[0])]) == 0
    out = capsys.readouterr().out
    assert "outputs: outputs.csv: 200 samples of " in out
    assert "few: report reproduced" in out


def test_what_is_changed_is_named(exported, tmp_path, capsys):
    files = {name: content for name, content in exported[1].items() if name != SUMS}
    name = f"{FOLDER}/reports/few.json"
    report = files[name].replace(b'"success_rate": 1.0', b'"success_rate": 0.5', 1)
    lines = refused(tmp_path, files | {name: report}, capsys)
    assert f"{name}: changed: its SHA3-256 checksum differs from the manifest" in lines
    assert "few: .variants.analytic_guidance.success_rate: 0.5 in the report, 1.0 now" in lines
    ssd = files["SystemStructure.ssd"].replace(b'stopTime="400"', b'stopTime="100"')
    assert ssd != files["SystemStructure.ssd"]
    lines = refused(
        tmp_path, {key: text for key, text in files.items() if key != name} | {"SystemStructure.ssd": ssd}, capsys
    )
    assert f"{name}: missing, though the manifest lists it" in lines


@pytest.mark.parametrize("name", either(["mine", "satellite_pointing"], ["mine"]))
def test_margins(fmus, name, tmp_path, monkeypatch, capsys):
    """Stored, and compared with those of a study: of a new system's loop, or of a shipped system's six."""
    monkeypatch.chdir(tmp_path)
    if name == "mine":
        assert main(["new", "system", name]) == 0
        assert main(["export", f"{name}/blocks.py"]) == 0
    assert main(["export", name, "--study", "stability"]) == 0
    with zipfile.ZipFile(f"{name}.ssp") as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    report = f"{FOLDER}/reports/stability.json"
    (loop, *_) = json.loads(files[report])["loops"]
    (expected, *_) = perilune.stability(name).to_json()["loops"]
    assert loop.items() <= expected.items()
    changed = files[report].replace(str(loop["modulus_margin"]).encode(), b"0.75", 1)
    lines = refused(tmp_path, files | {report: changed}, capsys)
    assert any(line.startswith("stability: .loops[1].modulus_margin: 0.75 in the report") for line in lines)


def test_no_such_study(fmus, tmp_path, monkeypatch, refusal):
    monkeypatch.chdir(tmp_path)
    message = "--study: papre: no such study of ssp_systems/lunar_terminal_guidance; use one of paper"
    assert message in refusal(["export", "lunar_terminal_guidance", "--study", "papre"])
    assert "flat_moon_lander is not a system, and the option applies only to systems" in refusal(
        ["export", "flat_moon_lander", "--study", "paper"]
    )
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("study", ["stability", "all"])
def test_a_campaign_with_the_name_of_another_study(fmus, tmp_path, monkeypatch, study, refusal):
    monkeypatch.chdir(tmp_path)
    shutil.copytree(SYSTEMS / "satellite_pointing", "pointing")
    shutil.copy("pointing/campaigns/agile.toml", "pointing/campaigns/stability.toml")
    assert "--study: stability: also a campaign of " in refusal(["export", "pointing", "--study", study])


def test_a_system_that_cannot_be_simulated_as_it_stands(tiny_folder, tmp_path, monkeypatch):
    """It has no stop time: exported without a trajectory, which a warning says."""
    folder = tmp_path / "open"
    folder.mkdir()
    ramp = component("ramp", "ramp", "output y Real m")
    gain = component("gain", "gain", "input u Real m; output y Real m")
    ssd = document(system(ramp, gain, connections=connection("ramp.y", "gain.u")), stop=None)
    (folder / "SystemStructure.ssd").write_text(ssd)
    for name in ("ramp", "gain"):
        (folder / "resources").mkdir(exist_ok=True)
        shutil.copy(tiny_folder / "native" / f"{name}.fmu", folder / "resources" / f"{name}.fmu")
    with pytest.warns(UserWarning, match="no trajectory included: .*stopTime: missing"):
        perilune.export(folder, output=tmp_path / "open.ssp")
    (verified,) = perilune.verify(tmp_path / "open.ssp")
    assert verified.problems == ("contains no trajectory, so there is nothing to reproduce",)


def test_timeout_is_of_repeated_campaigns_too(exported):
    """Simulations this short may be over before the watch looks at them, though not every time."""
    attempts = (perilune.verify(exported[0], timeout=1e-9)[0] for _ in range(10))
    cut = next(verified for verified in attempts if verified.reproduced == ())
    assert cut.studies == ("few",)
