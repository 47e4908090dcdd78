"""Folders of campaigns of unknown origin: each is merged, or refused in one line that names file and element.

Truth: a good folder, in which the tests change what they know; the errors are `InputError` and no others.
"""

from __future__ import annotations

import copy
import json
import os
import shutil

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.fly.campaign import open_folder
from perilune.analysis.campaigns.fly.manifest import FILE
from perilune.analysis.campaigns.fly.runner import merge_rows
from perilune.analysis.cli import main
from perilune.analysis.common.errors import InputError
from tests.support.lengths import either

pytestmark = pytest.mark.flies
SYSTEM = "lunar_terminal_guidance"


@pytest.fixture(scope="module")
def whole(tmp_path_factory, fmus):
    folder = tmp_path_factory.mktemp("hostile") / "out"
    command = ["batch", SYSTEM, "--campaign", "paper", "--configuration", "analytic_guidance", "--trials", "50"]
    assert main([*command, "--stop-time", "5", "--output", str(folder)]) == 0
    return folder


@pytest.fixture
def folder(whole, tmp_path):
    return shutil.copytree(whole, tmp_path / "out")


def outcome(folder):
    """Nothing, or the one line of what is refused."""
    try:
        rows = merge_rows(open_folder(folder))
        for each in rows.values():
            each.whole()
    except InputError as error:
        line = str(error)
        assert "\n" not in line
        assert ";" in line
        return line
    return None


def rewrite(path, change):
    """A shard with other columns, which says of itself what it said before."""
    table = pyarrow.parquet.read_table(path)
    groups = pyarrow.parquet.ParquetFile(path).metadata
    assert groups.num_row_groups == 1
    changed = change(table).replace_schema_metadata(table.schema.metadata)
    pyarrow.parquet.write_table(changed, path)


def with_column(table, name, column):
    return table.set_column(table.column_names.index(name), name, pyarrow.array(column))


SHARDS = {
    "fewer rows": (lambda table: table.slice(0, 5), "its rows are not trials 0 to 24"),
    "a trial twice": (lambda table: with_column(table, "trial", [0, *range(24)]), "its rows are not trials 0 to 24"),
    "in another order": (lambda table: table.take(list(range(24, -1, -1))), "its rows are not trials 0 to 24"),
    "another variant": (lambda table: with_column(table, "variant", ["other"] * 25), "not the rows of"),
    "no status": (lambda table: table.drop_columns(["status"]), "status: no such column"),
    "numbers for texts": (lambda table: with_column(table, "status", np.zeros(25)), "status: not a column of texts"),
    "texts for numbers": (
        lambda table: with_column(table, "end_time", ["x"] * 25),
        "end_time: not a column of numbers",
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
    assert problem in outcome(folder)


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
    assert f"{kind}, not a regular file" in outcome(folder)


MANIFESTS = {
    "trials": (lambda it: it.update(trials="50"), "trials: expected int, got str"),
    "no trials": (lambda it: it.update(trials=0), "trials: 0, not a positive number"),
    "far too many": (
        lambda it: it.update(trials=10**30),
        "trials: trials of a campaign: 1e+30 trials, at most 1e+09 are accepted",
    ),
    "another key": (lambda it: it.update(more=1), "more: not as this version of perilune writes it"),
    "a key less": (lambda it: it.pop("seed"), "missing required field seed"),
    "a file elsewhere": (lambda it: it["campaign"].update(content="../../x"), "not the name of a content"),
    "an option of trust": (lambda it: it["options"].update(in_process=True), "options.in_process: not an option"),
    "an option's type": (lambda it: it["options"].update(step="x"), "options.step: expected `float | null`"),
    "an FMU elsewhere": (
        lambda it: it["options"].update(use={"guidance": "/tmp/other.fmu"}),
        "/tmp/other.fmu is not among the files that the campaign's folder holds",
    ),
    "parameters elsewhere": (
        lambda it: it["options"].update(parameters=["/etc/hostname"]),
        "/etc/hostname is not among the files that the campaign's folder holds",
    ),
}


@pytest.mark.parametrize("name", MANIFESTS)
def test_manifests_are_checked(folder, name):
    change, problem = MANIFESTS[name]
    document = json.loads((folder / FILE).read_text())
    change(document)
    (folder / FILE).write_text(json.dumps(document))
    assert problem in outcome(folder)


JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(allow_nan=False),
    st.text(max_size=8),
    st.lists(st.integers(), max_size=2),
    st.dictionaries(st.text(max_size=3), st.integers(), max_size=2),
)


def paths_in(document, path=()):
    """The way to every value of a document."""
    yield path
    if isinstance(document, dict):
        items = document.items()
    else:
        items = enumerate(document) if isinstance(document, list) else ()
    for key, inner in items:
        yield from paths_in(inner, (*path, key))


@st.composite
def mutations(draw, document):
    """The document with one value changed, or gone."""
    changed = copy.deepcopy(document)
    path = draw(st.sampled_from([path for path in paths_in(document) if path]))
    inner = changed
    for key in path[:-1]:
        inner = inner[key]
    if draw(st.booleans()) or not isinstance(inner, dict):
        inner[path[-1]] = draw(JUNK)
    else:
        del inner[path[-1]]
    return changed


def test_any_manifest(whole, tmp_path):
    document = json.loads((whole / FILE).read_text())
    folder = shutil.copytree(whole, tmp_path / "out")

    @given(mutations(document))
    def check(changed):
        (folder / FILE).write_text(json.dumps(changed))
        outcome(folder)

    check()


@pytest.mark.parametrize("bits", either([1, 2, 3], [1]))
def test_any_bits_of_a_shard(whole, tmp_path, bits):
    folder = shutil.copytree(whole, tmp_path / "out")
    path = folder / "trials" / "000000.parquet"
    content = path.read_bytes()

    @given(st.lists(st.integers(0, 8 * len(content) - 1), min_size=bits, max_size=bits))
    def check(flipped):
        changed = bytearray(content)
        for bit in flipped:
            changed[bit // 8] ^= 1 << bit % 8
        path.write_bytes(changed)
        outcome(folder)

    check()
