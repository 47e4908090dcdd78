"""Synthesis of a law in a co-simulated system.

Truth: `perilune.batch` with the same law, draws and random streams; the same search with other numbers of
workers, or without interruption.
"""

import json

import pytest

import perilune
from perilune.analysis.design.laws.law import read_law
from perilune.analysis.design.synthesis import fitness
from perilune.analysis.design.synthesis.synthesis import run_synthesis
from perilune.analysis.design.synthesis.synthesis_file import read_synthesis
from perilune.common.errors import InputError
from tests.support.laws.campaign_text import CAMPAIGN, TEXT

pytestmark = pytest.mark.usefixtures("fmus")


def synthesis(folder, text=TEXT):
    path = folder / "search.toml"
    path.write_text(text)
    return read_synthesis(path)


@pytest.fixture(scope="module")
def whole(tmp_path_factory, fmus):
    """Run a search in one go, with its folder."""
    folder = tmp_path_factory.mktemp("whole")
    return run_synthesis(synthesis(folder), workers=1, output=folder / "out"), folder / "out"


def content(folder):
    """Return all files of a result but the drawing's and the checkpoint's bytes, which the others determine."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix in (".json", ".csv", ".ssv")}


@pytest.mark.parametrize("workers", [2, 3])
def test_any_number_of_workers_finds_the_same(whole, tmp_path, workers):
    actual = run_synthesis(synthesis(tmp_path), workers=workers, output=tmp_path / "out")
    assert actual.search.state.population == whole[0].search.state.population
    expected = content(whole[1])
    result = content(tmp_path / "out")
    assert json.loads(result.pop("pareto.json")) == json.loads(expected.pop("pareto.json")) | {
        "campaign": str(tmp_path / "search.toml")
    }
    assert result == expected


def test_objectives_are_sums_over_the_flights_of_a_batch(whole, tmp_path):
    result, folder = whole
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    flown = perilune.batch(
        "lunar_descent_2d",
        str(tmp_path / "campaign.toml"),
        parameters=[str(folder / "law.ssv")],
        step=0.5,
        stop_time=320.0,
        workers=1,
    )
    rows = flown.table().to_pylist()
    altitude = [abs(row["metric.final_altitude"] - 1500) + 100 * row["metric.ground_hit"] for row in rows]
    speed = [row["metric.final_speed"] for row in rows]
    chosen = result.search.choose().evaluation
    assert chosen.objectives == (sum(altitude), sum(speed))
    assert chosen.successes == sum(row["success"] for row in rows)
    assert chosen.flown == len(rows) == 4


def test_what_is_written(whole):
    result, folder = whole
    assert sorted(path.name for path in folder.iterdir()) == [
        "checkpoint.json",
        "draws.parquet",
        "law.json",
        "law.ssv",
        "log.csv",
        "pareto.json",
    ]
    law = read_law(folder / "law.json")
    assert law == result.law
    document = json.loads((folder / "pareto.json").read_text())
    assert document["format"] == "perilune-pareto-set"
    assert document["chosen"]["law"] == law.content()
    members = [tuple(value["sum"] for value in member["objectives"].values()) for member in document["members"]]
    chosen = result.search.choose().evaluation.objectives
    assert [*document["chosen"]["objectives"].values()] == [{"sum": total, "mean": total / 4} for total in chosen]
    assert chosen in members
    for point in members:
        assert not any(a[0] <= point[0] and a[1] <= point[1] and a != point for a in members)
    assert document["ended"] == "generations"
    lines = (folder / "log.csv").read_text().splitlines()
    assert lines[0] == "generation,evaluations,flights,front,successes,least_sum_of_altitude,least_sum_of_speed"
    assert [line.split(",")[0] for line in lines[1:]] == ["0", "1", "2", "3"]
    assert lines[-1].split(",")[1:3] == [str(document["evaluations"]), str(document["flights"])]


def test_a_search_in_pieces_finds_the_same(whole, tmp_path):
    search = synthesis(tmp_path)
    out = tmp_path / "out"
    first = run_synthesis(search, workers=1, output=out, evaluations=1)
    assert first.ended == "evaluations"
    assert first.search.state.generation == 0
    second = run_synthesis(search, workers=1, output=out, resume=True, evaluations=first.search.state.evaluations + 1)
    assert second.search.state.generation == 1
    result = run_synthesis(search, workers=2, output=out, resume=True)
    assert result.ended == "generations"
    assert content(out).keys() == content(whole[1]).keys()
    for name in ("law.json", "law.ssv", "log.csv", "checkpoint.json"):
        assert content(out)[name] == content(whole[1])[name], name
    repeated = run_synthesis(search, workers=1, output=out, resume=True)  # over already: nothing flies
    assert repeated.search.state.evaluations == result.search.state.evaluations


def test_an_interrupted_search_goes_on(whole, tmp_path, monkeypatch):
    calls = []

    def interrupt(*arguments):
        calls.append(1)
        if len(calls) == 20:
            raise KeyboardInterrupt
        return fly(*arguments)

    fly = fitness.fly_law
    monkeypatch.setattr(fitness, "fly_law", interrupt)
    out = tmp_path / "out"
    with pytest.raises(KeyboardInterrupt):
        run_synthesis(synthesis(tmp_path), workers=1, output=out)
    assert not (out / "law.json").exists()
    monkeypatch.undo()
    run_synthesis(synthesis(tmp_path), workers=1, output=out, resume=True)
    for name in ("law.json", "law.ssv", "log.csv", "checkpoint.json"):
        assert content(out)[name] == content(whole[1])[name], name


def refused(words, *arguments, **keywords):
    with pytest.raises(InputError) as caught:
        run_synthesis(*arguments, **{"workers": 1} | keywords)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_folder_with_a_search_is_not_overwritten(whole, tmp_path):
    search = synthesis(tmp_path)
    refused("the folder already contains a search; give resume to continue it", search, output=whole[1])
    refused("resume: no folder to resume from; give output", search, resume=True)
    refused("checkpoint.json: not found; leave out resume", search, output=tmp_path / "new", resume=True)
    refused("seed: differs from its value at the start of the search", search, seed=12, output=whole[1], resume=True)
    other = synthesis(tmp_path, TEXT.replace("variations = 4", "variations = 5"))
    refused("campaign_sha256: differs from its value at the start of the search", other, output=whole[1], resume=True)


def test_wrong_numbers_are_refused(tmp_path):
    search = synthesis(tmp_path)
    refused("workers: 0: not a positive number", search, workers=0)
    refused("evaluations: 0: not a positive number", search, evaluations=0)
    refused("seed: -1 is negative", search, seed=-1)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"guidance"\n', '"guide"\n', "network_operator.component: no component guide in the system; use one of"),
        ('"guidance"\n', '"plant"\n', "plant is an FMU planar_moon_lander, which has no parameter plant.matrix[1,1]"),
        (
            '"sensor.sample_period" = 0.5\n',
            "",
            "sensor.sample_period: 0.01 s is shorter than the communication step of 0.5 s",
        ),
        ('"abs(final_altitude - 1500)', '"final_altitude - 1e9', "objectives.altitude: -1e+09 in trial 0"),
        ("step = 0.5", "step = 0.7", "are not a whole number of steps of 0.7 s"),
        ("lunar_descent_2d", "no_such_system", "no_such_system"),
        ("plant.speed", "plant.sped", "plant.sped: neither a signal nor a parameter"),
    ],
)
def test_what_cannot_fly_is_refused_before_the_search(tmp_path, old, new, words):
    assert old in TEXT
    refused(words, synthesis(tmp_path, TEXT.replace(old, new)))
