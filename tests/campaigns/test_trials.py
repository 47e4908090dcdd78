"""TrialTable: subsets, joins, groups and numbers of trials, and metadata of columns.

Truth: the same columns in numpy, to the bit; units and meanings by hand.
"""

import itertools
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.trial_columns import describe_column
from perilune.analysis.campaigns.trials import TrialTable, join_trials
from perilune.common.machine.arrow import table_of

NUMBERS = st.floats(allow_nan=True, allow_infinity=True)


def table(misses, first=0):
    """Return trials of these misses, every third of which has failed and has a trace."""
    numbers = np.arange(first, first + len(misses))
    failed = numbers % 3 == 0
    return TrialTable.of(
        {
            "trial": numbers,
            "status": np.where(failed, "nonfinite", "finished").tolist(),
            "success": ~failed,
            "message": [f"x is nan in {trial}" if trial % 3 == 0 else "" for trial in numbers],
            "end_time": np.linspace(0.0, 1.0, numbers.size),
            "metric.miss": np.array(misses, dtype=float),
        },
        {trial: {"time": np.arange(2.0), "p.x": np.full(2, trial)} for trial in numbers[failed].tolist()},
    )


@given(st.lists(NUMBERS, min_size=1, max_size=20), st.randoms(use_true_random=False), st.data())
def test_parts_in_any_order_join_to_the_bit(misses, random, choices):
    whole = table(misses)
    cuts = sorted(choices.draw(st.sets(st.integers(1, len(misses)))) | {0, len(misses)})
    parts = [whole.part(range(*pair)) for pair in itertools.pairwise(cuts)]
    random.shuffle(parts)
    joined = pickle.loads(pickle.dumps(join_trials(parts)))  # as a cluster sends it
    assert joined.metrics["miss"].tobytes() == np.array(misses, dtype=float).tobytes()
    assert joined.statuses == whole.statuses
    assert joined.messages == {trial: f"x is nan in {trial}" for trial in range(0, len(misses), 3)}
    assert joined.success.tolist() == [trial % 3 != 0 for trial in range(len(misses))]
    assert joined.flown.tolist() == joined.success.tolist()
    assert joined.traced() == list(range(0, len(misses), 3))
    assert all(joined.trace(trial, ["p.x"])["p.x"].tolist() == [trial] * 2 for trial in joined.traced())


@given(st.lists(NUMBERS, min_size=1, max_size=20))
def test_blocks_are_of_the_trials_that_are_in_all_groups(misses):
    trials, column = table(misses), np.array(misses, dtype=float)
    groups = [("success", lambda success: success), ("trial", lambda numbers: numbers % 2 == 1)]
    (actual,) = trials.blocks("metric.miss", groups)()
    assert actual.tobytes() == column[[k for k in range(column.size) if k % 3 != 0 and k % 2 == 1]].tobytes()
    (everything,) = trials.blocks("metric.miss")()
    assert everything.tobytes() == column.tobytes()


def test_other_numbers_are_those_of_traces_and_messages():
    trials = table([1.0, 2.0, 3.0, 4.0]).renumber(9)
    assert trials.trial.tolist() == [9, 10, 11, 12]
    assert trials.traced() == list(trials.messages) == [9, 12]
    assert trials.messages[12] == "x is nan in 3"
    assert trials.trace(10) is None
    with pytest.raises(KeyError):
        trials.column("metric.mass")


def test_the_schema_says_what_columns_mean():
    provenance = {
        "success": "miss < 2",
        "metrics": {"miss": {"unit": "m", "description": "", "reduction": "final", "expression": "p.x"}},
        "signals": {"p.x": {"unit": "km"}},
        "sweep": {"p.gain": "1:2:0.5"},
    }
    columns = {
        name: np.zeros(2) for name in ("end_time", "draw.p.gain", "final.p.x", "metric.miss", "fault.stuck.start")
    }
    trials = TrialTable(table_of(columns)).described(lambda name: describe_column(name, provenance))
    assert {
        field.name: {key.decode(): text.decode() for key, text in field.metadata.items()} for field in trials.schema
    } == {
        "end_time": {"kind": "trial", "meaning": "time of the last row", "unit": "s"},
        "draw.p.gain": {"kind": "draw", "meaning": "swept: p.gain, 1:2:0.5"},
        "final.p.x": {"kind": "final", "meaning": "last value of p.x", "unit": "km"},
        "metric.miss": {"kind": "metric", "meaning": "final of p.x", "unit": "m"},
        "fault.stuck.start": {
            "kind": "fault",
            "meaning": "fault stuck: start time; nan where the fault is absent",
            "unit": "s",
        },
    }
    assert trials.units("metric.") == {"miss": "m"}
    assert not any(field.metadata for field in trials.table.schema)  # files of trials say nothing of it
