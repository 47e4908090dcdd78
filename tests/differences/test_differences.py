"""Comparison of two runs: differences, units, times, copies; the command and its page.

Truth: closed forms of the signals, numpy on the tables of two runs, unit factors.
"""

import json
import math

import numpy as np
import pyarrow.parquet
import pytest
from hypothesis import given
from hypothesis import strategies as st

import perilune
from perilune.analysis.cli import main
from perilune.analysis.differences.differences import compare_runs
from perilune.analysis.differences.recorded_run import RecordedRun
from perilune.common.errors import InputError
from tests.support.pages.checks import assert_self_contained, parse, text_of

TIME = np.linspace(0.0, 10.0, 101)


def run(time=TIME, units=(), discrete=(), **signals):
    columns = {name: np.broadcast_to(np.asarray(values, dtype=float), time.shape) for name, values in signals.items()}
    return RecordedRun("run", "", time, columns, dict(units), frozenset(discrete))


def only(runs):
    (signal,) = runs.signals
    return signal


def test_the_largest_difference_and_where():
    runs = compare_runs(run(h=np.sin(TIME), v=TIME), run(h=np.sin(TIME) + 0.5 * (TIME == 3.0), v=TIME))
    assert [each.name for each in runs.differing] == ["h"]
    assert runs.signals[0].greatest == 0.5
    assert runs.time[runs.signals[0].row] == 3.0
    assert runs.signals[0].relative == 0.5 / np.abs(np.sin(TIME) + 0.5 * (TIME == 3.0)).max()
    assert not runs.resampled


@pytest.mark.parametrize(
    ("first", "second", "factor"), [("rad", "deg", math.pi / 180.0), ("m", "km", 1e3), ("m/s", "kn", 1852.0 / 3600.0)]
)
def test_units_are_converted(first, second, factor):
    signal = only(compare_runs(run(h=factor * TIME, units={"h": first}), run(h=TIME, units={"h": second})))
    assert signal.unit == first
    assert signal.relative < 1e-15


def test_temperatures_have_an_offset():
    signal = only(compare_runs(run(h=TIME + 273.15, units={"h": "K"}), run(h=TIME, units={"h": "degC"})))
    assert signal.greatest < 1e-12
    back = only(compare_runs(run(h=TIME, units={"h": "degC"}), run(h=TIME + 273.15, units={"h": "K"})))
    assert back.greatest < 1e-12


def test_units_of_other_dimensions_are_not_compared():
    runs = compare_runs(run(h=TIME, units={"h": "m"}), run(h=TIME, units={"h": "kg"}))
    assert runs.unlike == [("h", "m", "kg")]
    assert not runs.signals


def test_an_unknown_unit_is_the_other_ones():
    assert only(compare_runs(run(h=TIME), run(h=TIME, units={"h": "m"}))).unit == "m"


def test_other_times_are_interpolated_and_integers_held():
    coarse = np.linspace(0.0, 12.0, 13)
    first = run(h=3.0 * TIME, phase=np.floor(TIME + 1e-9), discrete=["phase"])
    runs = compare_runs(first, run(coarse, h=3.0 * coarse, phase=coarse, discrete=["phase"]))
    assert runs.resampled
    assert np.array_equal(runs.time, TIME)
    by_name = {each.name: each for each in runs.signals}
    assert by_name["h"].greatest < 1e-12
    assert by_name["phase"].greatest == 0.0


def test_only_common_times_are_compared():
    runs = compare_runs(run(h=TIME), run(TIME + 8.0, h=TIME + 8.0))
    assert runs.time[0] >= 8.0
    assert only(runs).greatest < 1e-12
    with pytest.raises(InputError, match="no time in common"):
        compare_runs(run(h=TIME), run(TIME + 20.0, h=TIME))
    with pytest.raises(InputError, match="no signal in common"):
        compare_runs(run(h=TIME), run(v=TIME))


def test_copies_are_listed_once():
    runs = compare_runs(run(out=TIME, into=TIME), run(out=TIME + 1.0, into=TIME + 1.0))
    assert [(each.name, each.copy_of) for each in runs.signals] == [("out", ""), ("into", "out")]
    assert [each.name for each in runs.differing] == ["out"]


@pytest.mark.parametrize(
    ("first", "second", "greatest"),
    [
        (np.nan, np.nan, 0.0),
        (np.inf, np.inf, 0.0),
        (np.nan, 1.0, np.inf),
        (1.0, np.inf, np.inf),
        (-np.inf, np.inf, np.inf),
        (-1e308, 1e308, np.inf),
    ],
)
def test_what_is_not_finite_is_the_same_or_infinitely_far(first, second, greatest):
    assert only(compare_runs(run(h=first), run(h=second))).greatest == greatest


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=30), st.floats(-1e3, 1e3))
def test_a_constant_difference(values, shift):
    """Exchanging the runs keeps magnitudes; a run differs from itself by nothing."""
    time = np.arange(float(len(values)))
    first, second = run(time, h=values), run(time, h=np.array(values) + shift)
    forth, back = only(compare_runs(first, second)), only(compare_runs(second, first))
    assert forth.greatest == back.greatest == np.max(np.abs(second.signals["h"] - first.signals["h"]))
    assert forth.relative == back.relative <= 2.0
    assert not compare_runs(first, first).differing


@pytest.fixture(scope="module")
def tables(tmp_path_factory, fmus):
    folder = tmp_path_factory.mktemp("runs")
    system = "lunar_terminal_guidance"
    perilune.simulate(system).write(folder / "one.parquet")
    perilune.simulate(system, set={"plant.initial_mass": 951.0}).write(folder / "other.parquet")
    return folder / "one.parquet", folder / "other.parquet"


def differing_vectors(one, other, rows):
    """Return the vectors and scalars that differ beyond rounding, those with the values of an earlier one left out."""
    values, vectors = set(), set()
    for name in one.column_names[1:]:
        first, second = (table[name].to_numpy()[:rows].astype(float) for table in (one, other))
        largest = np.max(np.abs([first, second])) or 1.0
        key = first.tobytes(), second.tobytes()
        if np.max(np.abs(second - first)) > 1e-9 * largest and key not in values:
            vectors.add(name.partition("[")[0])
        values.add(key)
    return vectors


def test_two_runs_of_a_system(tables, tmp_path, capsys):
    document = tmp_path / "d.json"
    assert main(["diff", *map(str, tables), "--json", str(document), "--report", str(tmp_path / "d.html")]) == 0
    printed = capsys.readouterr().out
    one, other = (pyarrow.parquet.read_table(path) for path in tables)
    rows = min(one.num_rows, other.num_rows)
    by_name = {row["signal"]: row for row in json.loads(document.read_text())["signals"]}
    assert set(by_name) == set(one.column_names) - {"time"}
    for name in ("plant.mass", "plant.position[1]", "guidance.thrust_acceleration"):
        first, second = (table[name].to_numpy()[:rows] for table in (one, other))
        assert by_name[name]["difference"] == np.max(np.abs(second - first))
        assert by_name[name]["unit"] == one.schema.field(name).metadata[b"unit"].decode()
        assert (f"\n{name} " in printed) == (by_name[name]["relative"] > 1e-9)
    page = (tmp_path / "d.html").read_text()
    assert_self_contained(page)
    assert "Differences of two runs" in text_of(page)
    figures = parse(page).xpath("//figure")
    assert len(figures) == 2 * min(24, len(differing_vectors(one, other, rows)))
    assert main(["diff", str(tables[0]), str(tables[0]), "--report", str(tmp_path / "same.html")]) == 0
    assert "All signals that both runs have are identical" in text_of((tmp_path / "same.html").read_text())


def test_a_tolerance_decides_the_exit_status(tables, capsys):
    assert main(["diff", *map(str, tables), "--tolerance", "2.1"]) == 0
    assert main(["diff", *map(str, tables), "--tolerance", "1e-6"]) == 1
    assert "plant.mass: differs by" in capsys.readouterr().err
    assert main(["diff", str(tables[0]), str(tables[0]), "--tolerance", "0"]) == 0


def test_differences_of_rounding_are_one_line(tmp_path, capsys):
    """Truth: the fractions by which the tables differ."""
    (tmp_path / "a.csv").write_text("time,h,v,w\n0,1,2,1\n1,1,2,1\n")
    (tmp_path / "b.csv").write_text("time,h,v,w\n0,1,2.00000000002,1.5\n1,1.0000000005,2,1\n")
    files = [str(tmp_path / name) for name in ("a.csv", "b.csv")]
    page = tmp_path / "d.html"
    assert main(["diff", *files, "--report", str(page)]) == 0
    printed = capsys.readouterr().out
    line = "2 signals differ by at most 5e-10 of the largest magnitude, within the tolerance of 1e-09"
    assert [each for each in printed.splitlines() if each.startswith(("w ", "h ", "v ", "2 signals differ"))][1:] == [
        line
    ]
    (folded,) = parse(page.read_text()).xpath("//details[contains(summary, 'differ by at most')]")
    assert " ".join(folded.text_content().split()) == f"{line} h (5e-10), v (1e-11)"
    assert main(["diff", *files, "--tolerance", "0"]) == 1
    printed = capsys.readouterr()
    assert "differ by at most" not in printed.out
    assert printed.err.count("differs by") == 3


def test_a_signal_of_one_run_is_a_problem_under_a_tolerance(tmp_path):
    (tmp_path / "a.csv").write_text("time,h,v\n0,1,1\n1,1,1\n")
    (tmp_path / "b.csv").write_text("time,h\n0,1\n1,1\n")
    assert perilune.diff(tmp_path / "a.csv", tmp_path / "b.csv").problems() == []
    assert perilune.diff(tmp_path / "a.csv", tmp_path / "b.csv", tolerance=0.0).problems() == [
        "v: only one run has this signal"
    ]


@pytest.mark.parametrize("tolerance", ["nan", "-1"])
def test_a_tolerance_that_decides_nothing_is_refused(tmp_path, capsys, tolerance):
    (tmp_path / "a.csv").write_text("time,h\n0,1\n")
    assert main(["diff", str(tmp_path / "a.csv"), str(tmp_path / "a.csv"), f"--tolerance={tolerance}"]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_differences_that_are_not_finite_are_json(tmp_path):
    (tmp_path / "a.csv").write_text("time,h\n0,1\n1,nan\n")
    (tmp_path / "b.csv").write_text("time,h\n0,1\n1,2\n")
    assert main(["diff", str(tmp_path / "a.csv"), str(tmp_path / "b.csv"), "--json", str(tmp_path / "d.json")]) == 0
    (row,) = json.loads((tmp_path / "d.json").read_text())["signals"]
    assert (row["difference"], row["first"], row["second"]) == ("inf", None, 2.0)
