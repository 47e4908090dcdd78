"""perilune.analysis.campaigns.definition.requirements: keys of [requirement.NAME]; all others are refused by name."""

import pytest

from perilune.common.errors import InputError

METRICS = """
[metric.miss]
expression = "plant.x"
reduction = "final"
unit = "m"
"""
KEPT = """
[requirement.pinpoint]
expression = "miss < 10 and success"
share = "99.87 %"
confidence = 0.9
metric = "miss"
bound = "upper"
description = "where the crew waits"
[requirement.lands]
expression = "success"
share = 0.95
confidence = "95%"
"""


def test_everything_is_read(campaign):
    pinpoint, lands = campaign(METRICS + KEPT).requirements
    assert (pinpoint.name, pinpoint.share, pinpoint.confidence) == ("pinpoint", 0.9987, 0.9)
    assert (pinpoint.metric, pinpoint.bound, pinpoint.description) == ("miss", "upper", "where the crew waits")
    assert str(pinpoint) == "miss < 10 and success, 99.87 % probability at 90 % confidence"
    assert (lands.share, lands.confidence, lands.metric, lands.description) == (0.95, 0.95, None, "")
    assert campaign(METRICS).requirements == ()


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ('expression = "mis < 1"', "pinpoint.expression: 'mis' is not a metric; use one of miss, success"),
        ('expression = "1"', "pinpoint.expression: uses no metric"),
        ("share = 99.87", "pinpoint.share: 99.87 is not between 0 and 1; write a fraction, or a percentage in quotes"),
        ("share = 1", "pinpoint.share: 1 is not between 0 and 1"),
        ('share = "100 %"', "pinpoint.share: '100 %' is not between 0 and 1"),
        ('share = "much %"', "pinpoint.share: 'much ' is not constant"),
        ("share = true", "pinpoint.share: True is not a number"),
        (
            "confidence = 0.4",
            "pinpoint.confidence: 0.4 is below 0.5, where a requirement could be both met and not met",
        ),
        ('metric = "success"', "pinpoint.metric: 'success' is not a metric"),
        ('bound = "both"', "pinpoint.bound: 'both' is not known; use one of upper, lower"),
        ("flights = 3", "pinpoint.flights: unknown key"),
    ],
)
def test_what_is_wrong_is_said(campaign, line, words):
    key = line.split(" = ")[0]
    lines = [
        retained
        for retained in KEPT.split("[requirement.lands]")[0].splitlines()
        if not retained.startswith(f"{key} =")
    ]
    with pytest.raises(InputError) as error:
        campaign(METRICS + "\n".join([*lines, line]))
    assert str(error.value).startswith(f"test.toml: requirement.{words}")


@pytest.mark.parametrize("key", ["expression", "share", "confidence", "metric", "bound"])
def test_what_is_missing_is_said(campaign, key):
    lines = [
        retained
        for retained in KEPT.split("[requirement.lands]")[0].splitlines()
        if not retained.startswith(f"{key} =")
    ]
    with pytest.raises(InputError, match=rf"requirement\.pinpoint\.{key}: missing"):
        campaign(METRICS + "\n".join(lines))


@pytest.mark.parametrize(
    ("draw", "instead"),
    [
        ('distribution = "grid"\nvalues = [1, 2]', "choice"),
        ('distribution = "latin_hypercube"\nlow = 0\nhigh = 1', "uniform"),
        ('distribution = "sobol"\nlow = 0\nhigh = 1', "uniform"),
    ],
)
def test_draws_of_all_trials_together_are_refused(campaign, draw, instead):
    text = f"[draw.case]\n{draw}\n{METRICS}"
    assert campaign(text).draws
    with pytest.raises(InputError, match=rf"requirement: case has the distribution .*; use {instead}"):
        campaign(text + KEPT)


def test_names_are_plain(campaign):
    with pytest.raises(InputError, match=r"requirement\.a-b: 'a-b' is not a plain name"):
        campaign(METRICS + KEPT.replace("pinpoint", "a-b"))
