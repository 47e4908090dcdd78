"""Tables of numbers by trial that metrics look up: [lookup].

Truth: SHA-256 by hashlib of the inputs stored by a batch without the lookup; the numbers of the tables.
"""

import hashlib
import shutil

import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.cli import main
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.errors import InputError
from perilune.common.paths import SYSTEMS
from perilune.fmus_src.export.ssp_package import pack_system
from tests.support.foreign.odd_fmu import odd_system

BASE = """
system = "odd.ssp"
trials = 5
seed = 3
{scheme}
[draw."odd.gain"]
distribution = "uniform"
low = 1
high = 2
[derive]
twice = "2 * odd.gain"
[metric.last]
expression = "odd.y"
reduction = "final"
[success]
expression = "last < 100"
"""
LOOKUP = """
[lookup.reference]
file = "tables/reference.csv"
column = "second"
[lookup.reference.inputs]
gain = "odd.gain"
others = ["twice", "odd.count", 0.1]
[metric.looked_up]
expression = "reference"
reduction = "final"
[metric.difference]
expression = "odd.y - reference"
reduction = "max"
"""


def write_table(folder, rows, name="reference.csv"):
    """Write a table for gains; the numbers of trial k are k and 10 k."""
    lines = ["# made by: a tool", "# input: gain = odd.gain", "# input: others = twice, odd.count, 0.1"]
    lines.append("trial,inputs,first,second")
    for trial, gain in enumerate(rows):
        text = f"gain {gain.hex()}\nothers {(2.0 * gain).hex()} {(1.0).hex()} {(0.1).hex()}"
        lines.append(f"{trial},{hashlib.sha256(text.encode()).hexdigest()[:16]},{trial},{10 * trial}")
    (folder / "tables").mkdir(exist_ok=True)
    path = folder / "tables" / name
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture(params=["", 'draw_scheme = "counter"'], ids=["table", "counter"])
def folder(request, tmp_path):
    """Return a campaign with a lookup, its table and its system."""
    odd_system(tmp_path)
    base = BASE.format(scheme=request.param)
    (tmp_path / "base.toml").write_text(base)
    first = perilune.batch(tmp_path / "odd.ssp", tmp_path / "base.toml", workers=1)
    write_table(tmp_path, first.table().column("draw.odd.gain").to_pylist())
    (tmp_path / "c.toml").write_text(base + LOOKUP)
    return tmp_path


def batch(folder, **options):
    return perilune.batch(folder / "odd.ssp", folder / "c.toml", workers=1, **options)


def edit(path, before, after):
    text = path.read_text()
    assert text.count(before) == 1
    path.write_text(text.replace(before, after))


def test_metrics_have_the_numbers_of_their_trials(folder):
    rows = batch(folder).table().to_pylist()
    assert [row["metric.looked_up"] for row in rows] == [row["draw.reference"] for row in rows] == [0, 10, 20, 30, 40]
    assert batch(folder, trials=3).trials["default"].metrics["looked_up"].tolist() == [0, 10, 20]
    for row in rows[1:]:  # below its reference the largest difference is that of the last sample or an earlier one
        assert row["metric.difference"] >= row["metric.last"] - row["draw.reference"]


def test_a_folder_has_the_table(folder, capsys):
    """Replayed, gone on with and flown in shards without the campaign's files, to the same numbers."""
    expected = batch(folder, output=folder / "out").table()
    assert (
        main(["prepare", str(folder / "odd.ssp"), "--campaign", str(folder / "c.toml"), "--output", f"{folder}/p"]) == 0
    )
    shutil.copytree(folder / "tables", folder / "saved")
    edit(folder / "tables" / "reference.csv", ",4,40", ",4,41")
    with pytest.raises(InputError, match="holds another campaign"):
        batch(folder, output=folder / "out", resume=True)
    shutil.rmtree(folder / "tables")
    assert perilune.replay(folder / "out", 4).metrics["looked_up"] == 40.0
    assert main(["shard", f"{folder}/p", "0"]) == 0
    assert main(["merge", f"{folder}/p"]) == 0
    stored = pyarrow.parquet.read_table(folder / "p" / "trials")
    assert stored.column("metric.looked_up").to_pylist() == expected.column("metric.looked_up").to_pylist()
    capsys.readouterr()


@pytest.mark.parametrize(
    ("before", "after", "words"),
    [
        ("low = 1\n", "low = 1.5\n",
         r"reference.csv: trial 0: computed for inputs \(gain, others\) that differ from the inputs of default"),
        ("0.1]", "0.2]", "trial 0: computed for inputs"),
        ("seed = 3", "seed = 4", "trial 0: computed for inputs"),
        ("trials = 5", "trials = 6", "has 5 trials, but the campaign has 6 or more; give trials at most 5, or"),
        ('"second"', '"third"', "lookup.reference.column: .*reference.csv has no column 'third'"),
        ("tables/reference.csv", "none.csv", "lookup.reference.file: no file none.csv; compute the table"),
        ("others =", "further =", r"input: further, others: occurs in only one of the table and"),
        ('gain = "odd.gain"', 'gain = "odd.y"', "odd.y varies during a simulation; use draws"),
        ('gain = "odd.gain"', 'gain = "odd.gains"', "odd.gains.*neither a signal nor a parameter"),
        ("column =", "columns =", "columns: unknown key"),
        ("[lookup.reference.inputs]\n", "[lookup.reference.outputs]\n", "outputs: unknown key"),
        ("last < 100", "last < 100 and bound < 1", "bound"),
        ("[draw.", "[draw.reference]\ndistribution = 'uniform'\nlow = 0\nhigh = 1\n[draw.", "declared twice"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("folder", [""], indirect=True)
def test_wrong_lookups_are_one_line(folder, before, after, words):
    edit(folder / "c.toml", before, after)
    with pytest.raises(InputError, match=words) as error:
        batch(folder)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("before", "after", "words"),
    [
        ("trial,inputs", "trial,hash", "the header is not trial,inputs"),
        ("\n2,", "\n3,", "row 2: the row does not contain trial 2 and 4 columns"),
        (",2,20", ",2,much", "row 2: not numbers: 2, much"),
        (",2,20", ",2", "row 2: the row does not contain trial 2 and 4 columns"),
    ],
)
@pytest.mark.parametrize("folder", [""], indirect=True)
def test_wrong_tables_are_one_line(folder, before, after, words):
    edit(folder / "tables" / "reference.csv", before, after)
    with pytest.raises(InputError, match=f"reference.csv.*{words}"):
        batch(folder)


@pytest.mark.parametrize("folder", [""], indirect=True)
def test_a_path_is_meant_from_the_file_that_says_it(folder):
    """The campaign that extends another takes its table, or another one with the same inputs."""
    (folder / "deep").mkdir()
    path = folder / "deep" / "mine.toml"
    path.write_text('extends = "../c.toml"\ntrials = 2\n')
    actual = perilune.batch(folder / "odd.ssp", path, workers=1)
    assert actual.trials["default"].metrics["looked_up"].tolist() == [0, 10]
    path.write_text(path.read_text() + '[lookup.reference]\ncolumn = "first"\n')
    actual = perilune.batch(folder / "odd.ssp", path, workers=1)
    assert actual.trials["default"].metrics["looked_up"].tolist() == [0, 1]
    path.write_text(path.read_text() + 'file = "tables/reference.csv"\n')
    with pytest.raises(InputError, match=r"mine.toml: lookup.reference.file: no file tables/reference.csv"):
        perilune.batch(folder / "odd.ssp", path, workers=1)


@pytest.mark.parametrize("folder", [""], indirect=True)
def test_other_trials_than_the_campaigns_have_no_lookups(folder):
    """Draws from a file, and those of a study, are not those of the table."""
    output = folder / "out"
    batch(folder, output=output)
    with pytest.warns(UserWarning, match="looked_up, difference: omitted, since reference covers only the"):
        repeated = batch(folder, draws=output / "draws.parquet")
    assert list(repeated.trials["default"].metrics) == ["last"]
    call = {"failure": "looked_up > 1", "samples": 100, "workers": 1}
    with (
        pytest.warns(UserWarning, match="omitted"),
        pytest.raises(InputError, match="looked_up: neither a metric nor a draw"),
    ):
        perilune.rare(folder / "odd.ssp", folder / "c.toml", **call)
    edit(folder / "c.toml", "last < 100", "looked_up < 100")
    with pytest.raises(InputError, match="success: looked_up comes from a lookup table, which covers only the"):
        perilune.rare(folder / "odd.ssp", folder / "c.toml", **(call | {"failure": "last > 1"}))


def test_an_archive_has_the_table(fmus, tmp_path):
    archive = pack_system(SYSTEMS / "lunar_landing", [fmus], tmp_path)
    plans = [read_plan(system, "laws_approach", SystemOptions()) for system in (archive, "lunar_landing")]
    inside, outside = (plan.draws.of_part(range(300)).columns["bound"] for plan in plans)
    assert inside.tolist() == outside.tolist()
    assert 10.0 < inside.min() < inside.max() < 40.0
    assert plans[0].campaign_sha256 == plans[1].campaign_sha256
