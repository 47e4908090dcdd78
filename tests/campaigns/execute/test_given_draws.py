"""Supplied samples are simulated like drawn samples.

Truth: the batch that drew the samples, to the last bit; the closed form of the odd FMU for other samples.
"""

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.cli import main
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.studies.draw_space import DrawSpace
from perilune.analysis.studies.sample_flights import SampleFlights
from perilune.common.errors import InputError
from tests.support.foreign.odd_fmu import odd_system

SYSTEM, ONE = "lunar_terminal_guidance", {"guidance": ["analytic_guidance"]}
CAMPAIGN = """
system = "odd.ssp"
trials = 4
seed = 3
[draw.half]
distribution = "uniform"
low = 0
high = 1
[draw.late]
distribution = "uniform"
low = 0.25
high = 0.75
[derive]
"odd.gain" = "2 * half"
[fault.biased]
connector = "odd.y"
kind = "bias"
value = "half"
start = "late"
when = "half > 0.5"
[metric.last]
expression = "odd.y + 100 * half"
reduction = "final"
[success]
expression = "last < 100"
"""


@pytest.fixture
def odd(tmp_path):
    system = odd_system(tmp_path)
    (tmp_path / "c.toml").write_text(CAMPAIGN)
    return str(system), str(tmp_path / "c.toml")


def write(path, **columns):
    pyarrow.parquet.write_table(pyarrow.table(columns), path)
    return path


@pytest.mark.usefixtures("fmus")
def test_the_draws_of_a_batch_are_that_batch(tmp_path):
    first = perilune.batch(SYSTEM, "noisy", trials=4, compare=ONE, workers=1, output=tmp_path / "first")
    repeated = perilune.batch(
        SYSTEM, "noisy", draws=tmp_path / "first" / "draws.parquet", compare=ONE, workers=1, output=tmp_path / "again"
    )
    assert repeated.table().drop_columns([]).to_pylist() == first.table().to_pylist()
    assert (tmp_path / "again" / "draws.parquet").read_bytes() == (tmp_path / "first" / "draws.parquet").read_bytes()
    assert repeated.provenance["draws_sha256"]
    draws = pyarrow.parquet.read_table(tmp_path / "first" / "draws.parquet").slice(2, 1)
    third = draws.append_column("streams_of", pyarrow.array([2]))
    pyarrow.parquet.write_table(third, tmp_path / "third.parquet")
    alone = perilune.batch(
        SYSTEM, "noisy", draws=tmp_path / "third.parquet", compare=ONE, workers=1, output=tmp_path / "third"
    )
    metrics = [name for name in first.table().column_names if name.startswith("metric.")]
    assert [alone.table()[name][0].as_py() for name in metrics] == [first.table()[name][2].as_py() for name in metrics]
    compared = perilune.compare(tmp_path / "third")
    assert compared is not None


def expected(half, late):
    """Return the last y + 100 half, and the fault's bias where it acts."""
    return 2 * half * 0.5 + 2.0 + 100 * half + np.where(half > 0.5, half, 0.0)


def test_derived_values_faults_and_metrics_follow(odd, tmp_path):
    half, late = np.array([0.0, 0.25, 0.75]), np.array([0.25, 0.5, 0.5])
    result = perilune.batch(*odd, draws=write(tmp_path / "d.parquet", half=half, late=late))
    np.testing.assert_allclose(result.trials["default"].metrics["last"], expected(half, late), rtol=1e-14)
    assert result.table()["fault.biased"].to_pylist() == [False, False, True]
    assert result.plan.campaign.trials == 3


def test_a_page_says_how_to_fly_its_trials_again(odd, tmp_path, capsys):
    path = write(tmp_path / "d.parquet", half=np.array([0.0, 1.0, 0.3]), late=np.full(3, 0.5))
    line = ["batch", odd[0], "--campaign", odd[1], "--draws", str(path)]
    assert main([*line, "--report", str(tmp_path / "page.html")]) == 0
    assert f"--draws {path}" in (tmp_path / "page.html").read_text()
    assert main(["replay", line[1], "1", *line[2:], "--output", str(tmp_path / "replay.csv")]) == 1  # 104 is no success
    assert "104" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"half": [0.5]}, "late: the campaign draws this value, but the file has no such column"),
        ({"half": [0.5], "late": [0.5], "hulf": [1.0]}, "hulf: .* neither draws nor derives this value; .*half"),
        ({"half": [np.nan], "late": [0.5]}, "half: row 0 contains nan"),
        ({"half": ["a"], "late": [0.5]}, "half: not a column of numbers"),
        ({"half": [0.5], "late": [0.5], "streams_of": [-1]}, "streams_of: a value is not a trial number"),
        (
            {"half": pyarrow.array([], pyarrow.float64()), "late": pyarrow.array([], pyarrow.float64())},
            "the table is empty",
        ),
    ],
)
def test_refused_files(odd, tmp_path, columns, words):
    with pytest.raises(InputError, match=words):
        perilune.batch(*odd, draws=write(tmp_path / "d.parquet", **columns))


def test_a_file_that_is_none(odd, tmp_path):
    (tmp_path / "d.parquet").write_text("half\n1\n")
    with pytest.raises(InputError, match=r"d\.parquet: not Parquet"):
        perilune.batch(*odd, draws=tmp_path / "d.parquet")
    with pytest.raises(InputError, match="trials"):
        perilune.batch(*odd, draws=tmp_path / "d.parquet", trials=3)


@pytest.mark.parametrize("workers", [1, 2])
def test_samples_fly_one_table_after_another(odd, workers):
    plan = read_plan(*odd, SystemOptions())
    space = DrawSpace(plan.campaign)
    with SampleFlights(plan, space.from_normals(np.zeros((1, 2))), workers=workers) as flights:
        for count in (1, 7, 130):
            columns = space.from_normals(np.random.default_rng(count).standard_normal((count, 2)))
            trials, draws = flights.fly(columns, {})
            assert trials.trial.tolist() == list(range(count))
            assert trials.flown.all()
            np.testing.assert_allclose(trials.metrics["last"], expected(columns["half"], columns["late"]), rtol=1e-14)
            np.testing.assert_array_equal(draws["odd.gain"], 2 * columns["half"])
        assert flights.flown == 138
        assert flights.noise.components == ()
