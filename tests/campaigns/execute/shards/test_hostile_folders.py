"""Campaign folders of unknown origin: each is merged, or refused in one line that names file and element.

Truth: a valid folder with known changes; every error is an `InputError`.
"""

from __future__ import annotations

import json
import os
import shutil

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest
from hypothesis import settings

from perilune.analysis.campaigns.folder.campaign_manifest import FILE
from tests.fuzz.folders import any_manifest, any_shard, make_folder, merge
from tests.support.lengths import either

pytestmark = pytest.mark.flies
EXAMPLES = either(10000, 250)


@pytest.fixture(scope="module")
def whole(tmp_path_factory, fmus):
    return make_folder(tmp_path_factory.mktemp("hostile") / "out")


@pytest.fixture
def folder(whole, tmp_path):
    return shutil.copytree(whole, tmp_path / "out")


def rewrite(path, change):
    """Write a shard with other columns, whose metadata is as before."""
    table = pyarrow.parquet.read_table(path)
    groups = pyarrow.parquet.ParquetFile(path).metadata
    assert groups.num_row_groups == 1
    changed = change(table).replace_schema_metadata(table.schema.metadata)
    pyarrow.parquet.write_table(changed, path)


def with_column(table, name, column):
    return table.set_column(table.column_names.index(name), name, pyarrow.array(column))


SHARDS = {
    "fewer rows": (lambda table: table.slice(0, 5), "the rows are not the trials 0 to 24"),
    "a trial twice": (
        lambda table: with_column(table, "trial", [0, *range(24)]),
        "the rows are not the trials 0 to 24",
    ),
    "in another order": (lambda table: table.take(list(range(24, -1, -1))), "the rows are not the trials 0 to 24"),
    "another variant": (
        lambda table: with_column(table, "variant", ["other"] * 25),
        "contains rows of a variant other than",
    ),
    "no status": (lambda table: table.drop_columns(["status"]), "status: no such column"),
    "numbers for texts": (lambda table: with_column(table, "status", np.zeros(25)), "status: not a column of texts"),
    "texts for numbers": (
        lambda table: with_column(table, "end_time", ["x"] * 25),
        "end_time: not a column of numbers",
    ),
    "a name twice": (
        lambda table: table.append_column("end_time", pyarrow.array(np.zeros(25))),
        "end_time: two columns have this name",
    ),
    "nothing in a column": (
        lambda table: with_column(table, "success", [None] * 25),
        "success: not a column of numbers",
    ),
}


@pytest.mark.parametrize("name", SHARDS)
def test_shards_are_whole(folder, name):
    change, problem = SHARDS[name]
    rewrite(folder / "trials" / "000000.parquet", change)
    assert problem in merge(folder)


LINKS = {
    "a link": lambda path: path.symlink_to("/etc/passwd"),
    "a pipe": os.mkfifo,
    "a folder": lambda path: path.mkdir(),
}


@pytest.mark.parametrize("file", ["manifest.json", "trials/000001.parquet", "files"])
@pytest.mark.parametrize("kind", LINKS)
def test_files_are_regular(folder, file, kind):
    """A pipe is not opened, which would wait for a writer."""
    path = folder / file
    path = next(path.iterdir()) if path.is_dir() else path
    path.unlink()
    LINKS[kind](path)
    assert f"{kind}, not a regular file" in merge(folder)


MANIFESTS = {
    "trials": (lambda it: it.update(trials="50"), "trials: expected int, got str"),
    "no trials": (lambda it: it.update(trials=0), "trials: 0, not a positive number"),
    "far too many": (
        lambda it: it.update(trials=10**30),
        "trials: trials of a campaign: 1e+30 trials, at most 1e+09 are accepted",
    ),
    "another key": (lambda it: it.update(more=1), "more: unknown to this version of perilune"),
    "a key less": (lambda it: it.pop("seed"), "missing required field seed"),
    "a file elsewhere": (lambda it: it["campaign"].update(content="../../x"), "not a SHA-256"),
    "nothing compared": (
        lambda it: it["campaign"].update(compare={}),
        "campaign: the manifest has neither a comparison nor a selected variant",
    ),
    "an option of trust": (lambda it: it["options"].update(in_process=True), "options.in_process: not an option"),
    "an option's type": (lambda it: it["options"].update(step="x"), "options.step: expected `float | null`"),
    "an FMU elsewhere": (
        lambda it: it["options"].update(use={"guidance": "/tmp/other.fmu"}),
        "/tmp/other.fmu is not among the files in the campaign's folder",
    ),
    "parameters elsewhere": (
        lambda it: it["options"].update(parameters=["/etc/hostname"]),
        "/etc/hostname is not among the files in the campaign's folder",
    ),
}


@pytest.mark.parametrize("name", MANIFESTS)
def test_manifests_are_checked(folder, name):
    change, problem = MANIFESTS[name]
    document = json.loads((folder / FILE).read_text())
    change(document)
    (folder / FILE).write_text(json.dumps(document))
    assert problem in merge(folder)


@pytest.mark.parametrize("target", [any_manifest, any_shard])
def test_any_change(whole, tmp_path, target):
    settings(max_examples=EXAMPLES)(target(shutil.copytree(whole, tmp_path / "out")))()
