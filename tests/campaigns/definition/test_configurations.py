"""Configurations: settings, selection, and equality with a simulation with the same options.

Truth: the same campaign without configurations, with the options of one configuration on the command line.
"""

from pathlib import Path

import pytest

import perilune
from perilune.analysis.campaigns.definition.campaign import Variant
from perilune.common.errors import InputError

TEXT = """
[set]
"plant.mass" = 900

[configuration.plain]

[configuration.late]
use = { guidance = "analytic_guidance" }
parameters = ["ideal.ssv"]
set = { "plant.mass" = 950, "guidance.axis" = [1, 0, 0] }
"""
CAMPAIGN = """
system = "lunar_terminal_guidance"
trials = 3
seed = 5
[draw."plant.initial_mass"]
distribution = "normal"
mean = 940
sigma = 5
[metric.mass]
expression = "plant.mass"
reduction = "final"
unit = "kg"
[success]
expression = "mass > 0"
"""
TWO = """
[configuration.nominal]
[configuration.search]
use = { guidance = "astar_guidance" }
set = { "plant.gravity" = 1.65 }
"""


def test_each_has_its_fmus_sets_and_values(campaign):
    declared = campaign(TEXT)
    plain, late = declared.variants()
    assert plain == Variant("plain")
    assert late.use == {"guidance": "analytic_guidance"}
    layer = declared.layer_of(late)
    assert layer.set == {"plant.mass": 950, "guidance.axis": [1, 0, 0]}, "over those of [set]"
    assert layer.parameters == ("ideal.ssv",)
    assert declared.layer_of(plain).set == {"plant.mass": 900}


def test_one_is_selected(campaign):
    assert [each.name for each in campaign(TEXT).select("late").variants()] == ["late"]
    compared = campaign('[compare]\nguidance = ["a", "b"]\n')
    assert compared.select("b").variants() == [Variant("b", {"guidance": "b"})]


REFUSED = {
    "both": (
        '[compare]\nguidance = ["a", "b"]\n[configuration.x]\n',
        "configuration: cannot be combined with [compare]; write the compared FMUs as configurations, or",
    ),
    "unknown key": ('[configuration.x]\nfmu = "a"\n', "configuration.x.fmu: unknown key; allowed here: use"),
    "no component": ("[configuration.x.set]\nmass = 3\n", "configuration.x.set.mass: names no component; write"),
    "no text": ("[configuration.x.use]\nguidance = 3\n", "configuration.x.use.guidance: 3 is not a text; write"),
    "no name": ('[configuration."a b"]\n', "configuration.a b: 'a b' is not a plain name; use"),
    "dispersed": (
        '[draw."a.b"]\ndistribution = "normal"\nmean = 0\nsigma = 1\n[configuration.x.set]\n"a.b" = 1\n',
        "configuration.x.set.a.b: is also drawn or derived; keep one",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(campaign, case):
    text, message = REFUSED[case]
    with pytest.raises(InputError) as error:
        campaign(text)
    assert str(error.value).startswith(f"test.toml: {message}")


@pytest.fixture
def file(tmp_path) -> Path:
    path = tmp_path / "two.toml"
    path.write_text(CAMPAIGN + TWO)
    return path


@pytest.mark.usefixtures("fmus")
def test_flies_as_the_same_options_would(file, tmp_path):
    (plain := tmp_path / "plain.toml").write_text(CAMPAIGN)
    both = perilune.batch("lunar_terminal_guidance", file)
    assert list(both.summary) == ["nominal", "search"]
    options = {"use": {"guidance": "astar_guidance"}, "set": {"plant.gravity": 1.65}}
    alone = {
        "nominal": perilune.batch("lunar_terminal_guidance", plain),
        "search": perilune.batch("lunar_terminal_guidance", plain, **options),
    }
    for name, result in alone.items():
        truth = result.trials["default"].metrics["mass"]
        assert both.trials[name].metrics["mass"].tolist() == truth.tolist()
        chosen = perilune.batch("lunar_terminal_guidance", file, configuration=name)
        assert list(chosen.summary) == [name]
        assert chosen.trials[name].metrics["mass"].tolist() == truth.tolist()


@pytest.mark.usefixtures("fmus")
def test_stored_and_replayed(file, tmp_path):
    folder = tmp_path / "results"
    perilune.batch("lunar_terminal_guidance", file, configuration="search", output=folder)
    stored = perilune.replay(folder, 1)
    assert (stored.configuration, stored.stored, stored.differences) == ("search", True, ())
    replayed = perilune.replay("lunar_terminal_guidance", 1, campaign=file, configuration="search")
    assert replayed.metrics == stored.metrics
    assert list(perilune.merge(folder).summary) == ["search"]


WRONG = {
    "unknown": ({"configuration": "serach"}, "configuration serach: no such configuration; use one of search, nominal"),
    "use": ({"use": {"guidance": "x"}}, "use: guidance: the campaign's configurations choose this FMU"),
    "set": (
        {"set": {"plant.gravity": 3}},
        "set: plant.gravity: the campaign's configurations set",
    ),
}


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("case", WRONG)
def test_wrong_options(file, case):
    options, message = WRONG[case]
    with pytest.raises(InputError) as error:
        perilune.batch("lunar_terminal_guidance", file, **options)
    assert message in str(error.value)


@pytest.mark.usefixtures("fmus")
def test_a_study_is_of_one(file):
    with pytest.raises(
        InputError, match="the campaign has 2 variants, but a study needs one; give configuration nominal"
    ):
        perilune.sensitivity("lunar_terminal_guidance", file, base=64)


@pytest.mark.usefixtures("fmus")
def test_unknown_fmu_names_the_configuration(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text(CAMPAIGN + '[configuration.x]\nuse = { guidance = "no_such_guidance" }\n')
    with pytest.raises(InputError, match=r"wrong.toml: configuration.x.use: "):
        perilune.batch("lunar_terminal_guidance", path)
