"""perilune.analysis.campaigns.definition.faults: content of [fault.NAME], and the fault of each trial.

Truth: the draws of the table, inserted into the formulas here with Python's floats.
"""

import math

import numpy as np
import pytest

from perilune.analysis.campaigns.definition.plan import BatchPlan
from perilune.analysis.options.fault import Fault
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.errors import InputError

DRAWS = """
[draw.jet]
distribution = "grid"
values = [1, 2, 3, 4, 5, 6]
[draw.failure_time]
distribution = "uniform"
low = 10
high = 60
[draw.size]
distribution = "normal"
mean = 0
sigma = 1
[derive]
repair_time = "failure_time + 20"
"""
JETS = "".join(
    f"""
[fault.jet_{jet}]
connector = "plant.jet_factor[{jet}]"
kind = "override"
value = 0
start = "failure_time"
when = "jet == {jet}"
"""
    for jet in range(1, 7)
)
FAULT = '[fault.x]\nconnector = "a.b"\nkind = "{kind}"\nstart = {start}\n{rest}\n'


def fault(kind="bias", start=1, rest="value = 1"):
    return DRAWS + FAULT.format(kind=kind, start=start, rest=rest)


@pytest.fixture
def plan(campaign):
    def make(text, trials=12, **options):
        return BatchPlan("s", campaign(text, trials=trials), SystemOptions(), **options)

    return make


def test_each_of_six_jets_in_turn(plan):
    planned = plan(DRAWS + JETS)
    for trial in range(12):
        row = {name: column[trial] for name, column in planned.draws.columns.items()}
        jet = int(row["jet"])
        expected = [None] * 6
        expected[jet - 1] = Fault(f"plant.jet_factor[{jet}]", "override", 0.0, row["failure_time"])
        assert planned.faults_of(trial) == expected
    assert [fault.name for fault in planned.list_faults()] == [f"plant.jet_factor[{jet}]" for jet in range(1, 7)]
    assert planned.fault_texts()[2] == "jet_3: plant.jet_factor[3]=override:0@failure_time when jet == 3"


def test_value_and_times_are_expressions_over_draws(plan):
    planned = plan(fault("bias", '"failure_time / 2"', 'value = "2 * size"\nend = "repair_time"'))
    for trial in range(12):
        row = {name: column[trial] for name, column in planned.draws.columns.items()}
        start, end = row["failure_time"] / 2, row["failure_time"] + 20
        assert planned.faults_of(trial) == [Fault("a.b", "bias", 2 * row["size"], start, end)]
    assert planned.fault_texts() == ["x: a.b=bias:2 * size@failure_time / 2..repair_time"]


@pytest.mark.parametrize(
    ("text", "expected", "written"),
    [
        (fault("freeze", "50", "end = 70.5"), Fault("a.b", "freeze", 0.0, 50.0, 70.5), "x: a.b=freeze@50..70.5"),
        (fault("override", "0", "value = true"), Fault("a.b", "override", True, 0.0), "x: a.b=override:true@0"),
        (fault("bias", '"pi"', 'value = "-1e-3"'), Fault("a.b", "bias", -1e-3, math.pi), "x: a.b=bias:-1e-3@pi"),
        (fault(rest='value = -1\nwhen = "size < 0 or 1"'), Fault("a.b", "bias", -1.0, 1.0),
         "x: a.b=bias:-1@1 when size < 0 or 1"),
        (fault(rest='value = 2\nwhen = "0"'), None, "x: a.b=bias:2@1 when 0"),
    ],
)  # fmt: skip
def test_constants(plan, text, expected, written):
    planned = plan(text)
    assert planned.faults_of(3) == [expected]
    assert planned.fault_texts() == [written]
    if expected is not None:
        assert type(planned.faults_of(3)[0].value) is type(expected.value)


def test_the_users_come_after_the_campaigns(plan):
    own = Fault("c.d", "freeze", start=2.0)
    planned = plan(fault(), faults=(own,))
    assert planned.faults_of(0) == [Fault("a.b", "bias", 1.0, 1.0), own]
    assert planned.fault_texts() == ["x: a.b=bias:1@1", "c.d=freeze@2"]


def test_columns_of_the_table_of_trials(plan):
    end = 'end = "where(jet == 2, 100, repair_time)"'
    (sampled,) = (
        plan(fault("override", '"failure_time"', f'value = "size"\n{end}\nwhen = "jet < 3"'))
        .values_of(range(12))
        .faults
    )
    row = plan(DRAWS).draws.columns
    flies = row["jet"] < 3
    columns = sampled.columns()
    assert list(columns) == ["fault.x", "fault.x.value", "fault.x.start", "fault.x.end"]
    assert columns["fault.x"].tolist() == flies.tolist()
    np.testing.assert_array_equal(columns["fault.x.value"], np.where(flies, row["size"], np.nan))
    np.testing.assert_array_equal(columns["fault.x.start"], np.where(flies, row["failure_time"], np.nan))
    expected = np.where(row["jet"] == 2, 100.0, row["failure_time"] + 20.0)
    np.testing.assert_array_equal(columns["fault.x.end"], np.where(flies, expected, np.nan))
    (held,) = plan(fault("freeze", rest="")).values_of(range(12)).faults
    assert list(held.columns()) == ["fault.x", "fault.x.start", "fault.x.end"]
    assert held.columns()["fault.x.end"].tolist() == [math.inf] * 12


def test_what_does_not_fly_may_be_anything(plan):
    """1/0 and a window that ends before it begins, in trials without the fault."""
    text = fault("override", '"10 / (jet - 1)"', 'value = "sqrt(jet - 2)"\nend = "20 * (jet - 2)"\nwhen = "jet > 2"')
    assert [planned is None for planned in (plan(text).faults_of(trial)[0] for trial in range(6))] == [True] * 2 + [
        False
    ] * 4


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('[fault.x]\nkind = "melt"\n', "fault.x.kind: 'melt' is not known; use one of override, bias, freeze"),
        ('[fault.x]\nkind = "bias"\n', "fault.x.connector: missing; add connector = ... to the fault.x"),
        (fault("freeze"), "fault.x.value: a freeze has no value; omit the value: a freeze holds the current value"),
        (fault("bias", rest=""), "fault.x.value: missing"),
        ('[fault.x]\nconnector = "a.b"\nkind = "freeze"\n', "fault.x.start: missing"),
        (fault(rest="value = 1\nstop = 3"), "fault.x.stop: unknown key; allowed here: connector, kind, value, start,"),
        (fault(rest="value = inf"), "fault.x.value: inf is not a finite number; write a number, or an expression"),
        (fault(start="true"), "fault.x.start: True is not a finite number"),
        (fault(rest="value = [1]"), "fault.x.value: [1] is not a finite number"),
        (fault(rest="value = 1\nend = inf"), "fault.x.end: inf is not a finite number"),
        (
            fault(start='"failure_tim"'),
            "fault.x.start: 'failure_tim' is not a draw or a derived value; use one of fail",
        ),
        (fault(rest='value = 1\nwhen = "jett == 1"'), "fault.x.when: 'jett' is not a draw or a derived value"),
        (fault(rest="value = 1\nwhen = true"), "fault.x.when: True is not a text"),
        (fault(start='"1 +"'), "fault.x.start: invalid syntax"),
        (DRAWS + '[fault."a.b"]\n', "fault.a.b: 'a.b' is not a plain name"),
        ("fault = 1\n", "success.fault: unknown key"),
        (DRAWS + "[fault]\nx = 1\n", "fault.x: not a table; write [fault.x] and its keys below it"),
    ],
)
def test_a_wrong_file_is_refused_in_one_line(campaign, text, says):
    with pytest.raises(InputError) as caught:
        campaign(text)
    assert str(caught.value).startswith(f"test.toml: {says}")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (fault(start='"1 / (jet - 3)"'), "fault.x.start: '1 / (jet - 3)' is inf in trial 2; every value must be fin"),
        (fault(rest='value = "sqrt(3 - jet)"'), "fault.x.value: 'sqrt(3 - jet)' is nan in trial 3"),
        (fault(rest='value = 1\nwhen = "0 / (jet - 1)"'), "fault.x.when: '0 / (jet - 1)' is nan in trial 0"),
        (fault(rest='value = 1\nend = "1 / 0"'), "fault.x.end: '1 / 0' is inf in trial 0"),
        (fault(start=80, rest="value = 1\nend = 60"),
         "fault.x.end: 60 s is not after the start, 80 s, in trial 0; give an end after the start"),
        (fault(start=3, rest='value = 1\nend = "7 - jet"\nwhen = "jet > 1"'),
         "fault.x.end: 3 s is not after the start, 3 s, in trial 3"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_trial_is_refused_in_one_line(plan, text, says):
    with pytest.raises(InputError) as caught:
        plan(text).values_of(range(12))
    assert str(caught.value).startswith(f"test.toml: {says}")
    assert "\n" not in str(caught.value)
