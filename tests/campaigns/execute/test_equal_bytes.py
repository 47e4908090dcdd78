"""Equal campaigns have equal files of trials, independent of limits, links and flavour.

Truth: the files of the campaign simulated with default options; for folders of an earlier version, the naming rule of
that version.
"""

import hashlib
import json
import os
from dataclasses import replace

import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.campaigns.execute import loaded_campaign as opening
from perilune.common.paths import ROOT

SYSTEM = "lunar_terminal_guidance"
TRIALS = 3
pytestmark = pytest.mark.usefixtures("fmus")


def simulate(folder, system=SYSTEM, **options):
    options = {"trials": TRIALS, "workers": 1, "compare": {"guidance": ["analytic_guidance"]}} | options
    return perilune.batch(system, "paper", output=folder, **options)


def files_of(folder):
    paths = [folder / "draws.parquet", *sorted((folder / "trials").glob("*"))]
    return {path.name: path.read_bytes() for path in paths}


@pytest.fixture(scope="module")
def usual(fmus, tmp_path_factory):
    folder = tmp_path_factory.mktemp("usual") / "results"
    simulate(folder)
    return files_of(folder)


@pytest.mark.parametrize(
    "options", [{"timeout": 600.0}, {"call_timeout": 50.0, "memory": 3.0}, {"flavour": "native"}, {"flavour": "python"}]
)
def test_limits_and_flavour_change_no_byte_of_trials(usual, tmp_path, options):
    simulate(tmp_path / "results", **options)
    assert files_of(tmp_path / "results") == usual


def test_a_link_to_an_archive_changes_no_byte_of_trials(tmp_path):
    os.symlink(ROOT / "build" / "ssp" / f"{SYSTEM}.ssp", tmp_path / "link.ssp")
    simulate(tmp_path / "one", tmp_path / "link.ssp")
    simulate(tmp_path / "other", ROOT / "build" / "ssp" / f"{SYSTEM}.ssp")
    assert files_of(tmp_path / "one") == files_of(tmp_path / "other")


def test_another_seed_is_another_campaign(usual, tmp_path):
    simulate(tmp_path / "results", seed=5)
    assert files_of(tmp_path / "results") != usual


def test_a_batch_goes_on_with_another_timeout(tmp_path):
    simulate(tmp_path, timeout=600.0)
    simulate(tmp_path, timeout=300.0, trials=30, resume=True)
    assert json.loads((tmp_path / "manifest.json").read_text())["timeout"] == 300.0
    assert perilune.open_results(tmp_path).provenance["trials"] == 30


def test_a_folder_of_an_earlier_version_goes_on(tmp_path, monkeypatch):
    gather = opening.make_manifest

    def gather_as_before(plan, systems):
        manifest, contents = gather(plan, systems)
        return replace(manifest, identities=None), contents

    with monkeypatch.context() as patch:
        patch.setattr(opening, "make_manifest", gather_as_before)
        simulate(tmp_path, trials=26)
    before = files_of(tmp_path)
    manifest = json.loads((tmp_path / "manifest.json").read_text())
    assert "identities" not in manifest
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["manifest"] == digest(manifest)
    del summary["variants"]
    path = tmp_path / "trials" / "000000.parquet"
    about = json.loads(pyarrow.parquet.read_schema(path).metadata[b"perilune"])
    assert about["batch"] == digest(summary)
    simulate(tmp_path, trials=30, resume=True)
    assert files_of(tmp_path)["000000.parquet"] == before["000000.parquet"]
    assert perilune.replay(tmp_path, 2).differences == ()
    assert perilune.open_results(tmp_path).provenance["trials"] == 30


def digest(document):
    """Return the digest by which versions before identities named manifests and batches."""
    return hashlib.sha256(json.dumps({**document, "trials": None}, sort_keys=True).encode()).hexdigest()
