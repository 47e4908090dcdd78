"""Arguments shared by several Python verbs are accepted in the same forms: slots to compare, paths, lists, folders.

Truth: the same call in list form; the signatures of the public functions.
"""

from __future__ import annotations

import inspect
from pathlib import Path

import numpy as np
import pytest

import perilune
from tests.api.test_flights import pictures
from tests.support.foreign.linear_system import linear_system
from tests.support.pages.studies import SUM, rare_study, sensitivity_study, worst_study

SYSTEM = "lunar_terminal_guidance"
COMPARING = {
    "batch": {"trials": 1},
    "rare": {"failure": "flight_time > 200", "samples": 100},
    "worst": {"metric": "flight_time", "flights": 120, "noise_trial": 0},
    "sensitivity": {"base": 32},
}
RESULTS = {"rare": rare_study, "worst": worst_study, "sensitivity": sensitivity_study}


class AskedError(Exception):
    """A plan was read: what was compared."""


@pytest.mark.parametrize("name", COMPARING)
@pytest.mark.parametrize("fmus", [["analytic_guidance"], ("analytic_guidance",), "analytic_guidance"])
def test_compare_takes_a_list(name, fmus, monkeypatch):
    def read(*_, compare, **__):
        raise AskedError(compare)

    monkeypatch.setattr("perilune.analysis.verbs.common.campaign_options.read_plan", read)
    with pytest.raises(AskedError) as requested:
        getattr(perilune, name)(SYSTEM, "paper", compare={"guidance": fmus}, **COMPARING[name])
    assert requested.value.args == ({"guidance": ["analytic_guidance"]},)


def test_these_are_all_that_compare():
    with_compare = {
        name
        for name in perilune.__all__
        if callable(getattr(perilune, name))
        and name[0].islower()
        and "compare" in inspect.signature(getattr(perilune, name)).parameters
    }
    assert with_compare == {*COMPARING, "prepare", "replay"}


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("name", ["simulate", "describe", "validate", "stability", *COMPARING])
def test_parameters_take_paths(name, tmp_path):
    """A file that is not there is named by all of them alike, so that all have read the list."""
    missing = tmp_path / "missing.ssv"
    system = "hover_transfer" if name == "stability" else SYSTEM  # which declares loops
    more = {}
    if name in COMPARING:
        more = {"campaign": "paper", "compare": {"guidance": "analytic_guidance"}, **COMPARING[name]}
    said = ""
    try:
        actual = getattr(perilune, name)(system, parameters=[missing], **more)
        said = actual[0].problems[0]  # of validate
    except perilune.InputError as error:
        said = str(error)
    assert "missing.ssv" in said


@pytest.fixture(scope="module", params=RESULTS)
def result(request, tmp_path_factory):
    return RESULTS[request.param](tmp_path_factory.mktemp(request.param))


def test_a_study_is_written_to_a_folder_by_its_name(result, tmp_path):
    result.write(str(tmp_path / "out"))
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written == {path.name for path in result.folder.iterdir()}
    assert "flights.parquet" in written


def test_a_notebook_shows_a_study(result):
    text = result._repr_html_()
    assert len(pictures(text)) == 1
    assert f"{type(result).__name__}(linear" in repr(result)
    for name in ("a.gain", "b.gain", "c.gain"):
        assert name in text
    assert result.plot().axes


def test_batches_and_comparisons_take_names_and_lists(tmp_path):
    system, _ = linear_system(tmp_path)
    (tmp_path / "sum.toml").write_text(SUM)
    batch = perilune.batch(system, tmp_path / "sum.toml", trials=4, workers=1)
    batch.write(str(tmp_path / "one"))
    one_by_one = perilune.compare(str(tmp_path / "one"))
    as_list = perilune.compare([tmp_path / "one"])
    assert list(as_list.contenders) == list(one_by_one.contenders)
    np.testing.assert_array_equal(
        perilune.open_results(str(tmp_path / "one")).arrow(["metric.total"])["metric.total"].to_numpy(),
        batch.trials["default"].metrics["total"],
    )
    checked = perilune.validate([system, str(tmp_path / "sum.toml")])
    assert [check.path for check in checked] == [system, str(tmp_path / "sum.toml")]
    assert not checked.problems()


def test_a_law_is_written_to_a_file_by_its_name(tmp_path):
    name = perilune.inventory().laws[0]
    perilune.law(name).write(str(tmp_path / "law.json"))
    assert perilune.law(tmp_path / "law.json").matrix == perilune.law(name).matrix
    assert Path(tmp_path / "law.json").is_file()
