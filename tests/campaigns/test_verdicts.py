"""perilune.analysis.campaigns.requirement_verdicts: verdicts on requirements from a variant's trials, and their texts.

Truth: failures counted by hand; verdicts of tests/campaigns/verdicts; [success], which has the same rule.
"""

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binom

from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.metrics import successes
from perilune.analysis.campaigns.definition.requirements import Requirement
from perilune.analysis.campaigns.plain_text import ordinal
from perilune.analysis.campaigns.requirement_verdicts import (
    ToleranceBound,
    requirement_verdict,
    satisfies,
    trials_to_decision,
)
from perilune.analysis.campaigns.summary import requirement_values, summarise
from perilune.analysis.campaigns.summary_text import summary_text
from perilune.analysis.campaigns.tables import unmet_lines
from perilune.analysis.campaigns.verdicts.stopping import stopping_rule
from perilune.common.to_json import to_json
from tests.support.campaigns.trial_tables import trial_table

NEAR = Requirement("near", Expression("miss < 1"), 0.9987, 0.9, "miss", "upper")
HEAVY = Requirement("heavy", Expression("mass > 5 and success"), 0.9, 0.9, "mass", "lower")
NUMBERS = st.floats(allow_nan=True, allow_infinity=True)


def columns(miss, mass=None, success=None):
    """Return a variant from its metrics."""
    miss = np.asarray(miss, dtype=float)
    mass = np.full(miss.size, 6.0) if mass is None else np.asarray(mass, dtype=float)
    success = np.full(miss.size, True) if success is None else np.asarray(success)
    return trial_table(["finished"] * miss.size, success, {"miss": miss, "mass": mass})


def flights(count, failures):
    """Return a variant whose first flights miss."""
    return columns(np.where(np.arange(count) < failures, 2.0, 0.5))


def decided(requirements, **variants):
    """Return the number of these trials after which all requirements are decided."""
    flown = {
        name: [satisfies(requirement, trials) for requirement in requirements] for name, trials in variants.items()
    }
    return trials_to_decision(requirements, flown)


@given(st.lists(st.tuples(NUMBERS, NUMBERS), min_size=1, max_size=20))
def test_a_flight_is_judged_as_by_success(rows):
    text = "miss / mass < 1 or mass == 0"
    miss, mass = np.array(rows).T
    actual = satisfies(Requirement("r", Expression(text), 0.9, 0.9), columns(miss, mass))
    each = [successes(Expression(text), {"miss": np.array([a]), "mass": np.array([b])}, 1) for a, b in rows]
    assert actual.tolist() == np.concatenate(each).tolist()


def test_a_flight_that_did_not_end_fails_it():
    """Its metrics are nan, which a comparison turned round would let pass."""
    trials = columns([0.5, math.nan, math.inf, -math.inf], success=[True, False, False, False])
    assert satisfies(Requirement("r", Expression("not miss >= 1"), 0.9, 0.9), trials).tolist() == [
        True,
        False,
        False,
        False,
    ]
    assert satisfies(Requirement("r", Expression("success"), 0.9, 0.9), trials).tolist() == [True, False, False, False]


@pytest.mark.parametrize(
    ("count", "failures", "verdict", "missing"),
    [
        (1771, 0, "met", [None] * 3),
        (1770, 0, "undecided", [1, 1221, 2323]),
        (2991, 1, "met", [None] * 3),
        (2000, 1, "undecided", [991, 2093, 3138]),
        (4093, 2, "met", [None] * 3),
        (1771, 6, "not met", [None] * 3),
    ],
)
def test_a_campaign_of_a_fixed_size(count, failures, verdict, missing):
    actual = requirement_verdict(NEAR, flights(count, failures))
    assert (actual.verdict, actual.flights, actual.failures) == (verdict, count, failures)
    assert actual.consumer_risk == pytest.approx(binom.cdf(failures, count, 0.0013))
    assert list(actual.flights_to_decide.values()) == missing
    assert actual.decided_after == (None if verdict == "undecided" else count)
    assert actual.rule == "fixed size"


def test_bounds():
    """The worst of 1771 flights is the bound; of 38, the worst but one is for 90 % at 90 %."""
    actual = requirement_verdict(NEAR, columns(np.arange(1771) / 1000)).bound
    assert actual == ToleranceBound("miss", "upper", 1.77, rank=1, flights=1771, flights_to_decide=0)
    few = requirement_verdict(NEAR, columns(np.ones(1000))).bound
    assert (few.value, few.rank, few.flights_to_decide) == (None, None, 771)
    low = requirement_verdict(HEAVY, columns(np.zeros(38), np.arange(38))).bound
    assert (low.value, low.rank) == (1.0, 2)
    lost = requirement_verdict(HEAVY, columns(np.zeros(38), [math.nan, math.nan, *range(36)])).bound
    assert lost.value == -math.inf
    assert to_json(lost)["value"] == "-inf"


def test_until_decided_only_the_looks_count():
    early = requirement_verdict(NEAR, flights(2300, 0), until_decided=True)
    assert (early.verdict, early.decided_after, early.rule) == ("met", 2300, "until decided")
    assert early.bound.rank == 1
    fixed = requirement_verdict(NEAR, flights(1771, 0), until_decided=True)
    assert fixed.verdict == "undecided"
    assert fixed.flights_to_decide == {0: 529, 1: 2229, 2: 3829}
    assert fixed.bound.flights_to_decide == 529
    late = np.full(3000, 0.5)
    late[2500:] = 2.0  # after the verdict, which stands
    actual = requirement_verdict(NEAR, columns(late), until_decided=True)
    assert (actual.verdict, actual.decided_after, actual.failures) == ("met", 2300, 500)


def test_all_of_all_variants_have_to_be_decided():
    rule = stopping_rule(0.9, 0.9)
    first = next(count for count in rule.looks(100) if rule.acceptance_number(count) >= 0)
    assert decided([HEAVY], a=flights(200, 0)) == first
    assert decided([NEAR, HEAVY], a=flights(2400, 0)) == 2300
    assert decided([NEAR, HEAVY], a=flights(2299, 0)) is None
    assert decided([NEAR], a=flights(2400, 0), b=flights(2400, 1)) is None
    assert decided([NEAR], a=flights(4100, 0), b=flights(4100, 1)) == 4000
    assert decided([], a=flights(10, 0)) is None


def test_parts_that_arrive_change_nothing():
    """However many trials have flown when it is asked, the answer is the same once there is one."""
    source = np.random.default_rng(6)
    trials = columns(np.where(source.uniform(size=6000) < 0.0004, 2.0, 0.5), source.uniform(4.7, 9.0, 6000))
    miss, mass = trials.metrics.values()
    whole = decided([NEAR, HEAVY], a=trials)
    assert whole is not None
    for count in (whole, whole + 1, 6000):
        assert decided([NEAR, HEAVY], a=columns(miss[:count], mass[:count])) == whole
    assert decided([NEAR, HEAVY], a=columns(miss[: whole - 1], mass[: whole - 1])) is None


@pytest.fixture(scope="module")
def summary():
    variants = {"good": flights(2000, 0), "odd": flights(2000, 1), "bad": flights(2000, 300)}
    return summarise(variants, requirements=[NEAR, HEAVY])


def test_the_summary_has_them(summary):
    assert [entry.requirements["near"].verdict for entry in summary.values()] == ["met", "undecided", "not met"]
    document = to_json(summary)
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["odd"]["requirements"]["near"]["flights_to_decide"] == {"0": 991, "1": 2093, "2": 3138}
    values = requirement_values(summary)
    assert Expression("odd.requirements.near.failures == 1 and good.requirements.near.bound.value == 0.5").evaluate(
        values
    )
    assert "requirements" not in to_json(summarise({"good": flights(9, 0)}))["good"]


def test_lines_name_variant_requirement_and_figures(summary):
    assert unmet_lines(summary) == [
        "odd: requirement near: miss < 1, 99.87 % probability at 90 % confidence: undecided: 1 of 2000 trials "
        "failed; 991, 2093 or 3138 additional trials with 0, 1 or 2 further failures would meet it",
        "bad: requirement near: miss < 1, 99.87 % probability at 90 % confidence: not met: 300 of 2000 trials failed",
    ]


def test_a_metric_that_no_flight_has_is_named():
    """As of an instant that is never reached: it read `60 of 60 trials failed`."""
    requirements = [NEAR, HEAVY]
    never = summarise({"never": columns(np.full(60, np.nan))}, requirements=requirements)
    assert unmet_lines(never)[0].endswith(": not met: miss is evaluated in none of 60 flights")
    assert "never: miss is evaluated in none of 60 flights" in summary_text(never)
    assert "no upper bound of miss" not in summary_text(never)
    assert to_json(never)["never"]["requirements"]["near"]["unevaluated"] == ["miss"]
    assert never["never"].requirements["heavy"].unevaluated is None
    single = summarise({"single": columns([*[np.nan] * 59, 2.0])}, requirements=requirements)
    assert unmet_lines(single)[0].endswith("not met: 60 of 60 trials failed")
    assert "unevaluated" not in to_json(single)["single"]["requirements"]["near"]


def test_text(summary):
    lines = summary_text(summary).splitlines()
    start = next(index for index, line in enumerate(lines) if line.startswith("requirement"))
    cells = [line.split("at 90 % confidence")[1].split() for line in lines[start + 1 : start + 4]]
    assert cells == [
        ["good", "2000", "0", "7.41", "met", "-,", "-,", "-"],
        ["odd", "2000", "1", "26.72", "undecided", "991,", "2093,", "3138"],
        ["bad", "2000", "300", "100.00", "not", "met", "-,", "-,", "-"],
    ]
    assert "good: miss <= 0.5 m with 99.87 % probability at 90 % confidence: the worst of 2000" in lines
    permitted = max(count for count in range(300) if binom.cdf(count, 2000, 0.1) <= 0.1)
    assert (
        f"good: mass >= 6 kg with 90 % probability at 90 % confidence: {ordinal(permitted + 1)} worst of 2000" in lines
    )


def test_text_of_a_bound_that_takes_more_flights():
    variants = {"x": flights(1000, 0)}
    actual = summarise(variants, requirements=[NEAR])
    line = (
        "x: no upper bound of miss with 99.87 % probability at 90 % confidence: 771 more trials are needed for a bound"
    )
    assert line in summary_text(actual).splitlines()
