"""Groups of trials in perilune.analysis.campaigns.definition.campaign and in plans.

Truth: a dictionary of the trials for each value.
"""

from collections import defaultdict

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.definition.campaign import MAXIMUM_GROUPS, groups_of
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.plan import BatchPlan
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.errors import InputError

WHERE = ("c.toml", "group.by")
CASES = '[draw.case]\ndistribution = "choice"\nvalues = [3, 1, 2.5]\n'


@given(st.lists(st.integers(-3, 30).map(lambda k: k / 4), min_size=1, max_size=200))
def test_every_trial_is_in_the_group_of_its_value(values):
    expected = defaultdict(list)
    for trial, value in enumerate(values):
        expected[value].append(trial)
    column = np.array(values)
    groups = groups_of([column[:3], column[3:]], WHERE)
    assert [group.value for group in groups] == sorted(expected)
    assert {group.value: np.flatnonzero(group.has(column)).tolist() for group in groups} == expected
    assert [float(group.label) for group in groups] == sorted(expected)


@pytest.mark.parametrize(
    ("values", "labels"),
    [
        ([2.0, 1.0, 1.0], ["1", "2"]),
        ([-0.0, 0.0], ["0"]),
        ([0.1 + 0.2, 16648.0, -1.65], ["-1.65", "0.3", "16648"]),
        ([0.1 + 0.2, 0.3], ["0.3", "0.30000000000000004"]),  # distinguished whatever digits it takes
        ([1e-7], ["1e-07"]),
    ],
)
def test_labels(values, labels):
    assert [group.label for group in groups_of([np.array(values)], WHERE)] == labels
    for label in labels:
        assert Expression(f'default.groups["{label}"].trials').names == {f'default.groups["{label}"].trials'}


def test_too_many_groups_are_refused_in_one_line():
    assert len(groups_of([np.arange(float(MAXIMUM_GROUPS))], WHERE)) == 100
    with pytest.raises(InputError) as caught:
        groups_of([np.arange(MAXIMUM_GROUPS + 1.0).repeat(2)], WHERE)
    says = "has at least 101 different values, and each would form a group; group by a quantity with at most 100 values"
    assert str(caught.value) == f"c.toml: group.by: {says}"


def test_a_plan_has_the_groups_of_its_draws(campaign):
    text = CASES + '[derive]\nhalf = "floor(case) / 2"\n[group]\nby = "half"\n'
    plan = BatchPlan("s", campaign(text, trials=50), SystemOptions())
    case, half = plan.draws.columns["case"], plan.draws.columns["half"]
    assert {group.label: np.flatnonzero(group.has(half)).tolist() for group in plan.groups} == {
        "0.5": np.flatnonzero(case == 1).tolist(),
        "1": np.flatnonzero(case == 2.5).tolist(),
        "1.5": np.flatnonzero(case == 3).tolist(),
    }
    assert BatchPlan("s", campaign(CASES), SystemOptions()).groups == []


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (CASES + "[group]\n", "group.by: missing; add by = ... to the group"),
        (CASES + '[group]\nby = "cases"\n', "group.by: 'cases' is not a draw or a derived value; use one of case"),
        (CASES + "[group]\nby = 1\n", "group.by: 1 is not a text"),
        (CASES + '[group]\nby = "case"\nof = "x"\n', "group.of: unknown key; allowed here: by"),
        (CASES + 'group = "case"\n', "draw.case.group: unknown key"),
        ('[group]\nby = "case"\n', "group.by: 'case' is not a draw or a derived value; none is available"),
    ],
)
def test_what_is_wrong_is_named_with_its_place(campaign, text, says):
    with pytest.raises(InputError) as caught:
        campaign(text)
    assert str(caught.value).startswith(f"test.toml: {says}")
    assert "\n" not in str(caught.value)
