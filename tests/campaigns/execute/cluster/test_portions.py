"""Content of tasks: every trial once, in tasks of some seconds.

Truth: the list of all trials, and durations known in advance.
"""

from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.execute.cluster.tasks import FIRST, LONGEST, SHORTEST, TaskSplitter, TrialSpan, halve
from perilune.analysis.campaigns.folder.numbering import Numbering

VARIANTS = ("a", "b")


def all_of(portions, threads, seconds):
    """Return tasks in turn, each measured as soon as it is issued."""
    actual = []
    while task := portions.next(threads):
        actual.append(task)
        for piece in task:
            portions.record_duration(piece, seconds[piece.variant] * len(piece.trials))
    return actual


@given(
    trials=st.integers(1, 700),
    size=st.integers(1, 90),
    threads=st.integers(1, 40),
    seconds=st.fixed_dictionaries({name: st.floats(0.0, 50.0) for name in VARIANTS}),
)
def test_every_trial_once(trials, size, threads, seconds):
    numbering = Numbering(trials, size)
    portions = TaskSplitter(numbering, range(numbering.count), VARIANTS)
    actual = [piece for task in all_of(portions, threads, seconds) for piece in task]
    flown = [(piece.variant, trial) for piece in actual for trial in piece.trials]
    assert sorted(flown) == [(name, trial) for name in VARIANTS for trial in range(trials)]
    assert all(set(piece.trials) <= set(numbering.of(piece.shard)) for piece in actual)
    assert portions.trials == 0


@given(trial=st.floats(1e-4, 1.0), threads=st.integers(1, 20))
def test_tasks_of_some_seconds(trial, threads):
    """Not longer than they are to be, or one trial; and but for the last one not so short that sending them counts."""
    numbering = Numbering(1000, 25)
    seconds = dict.fromkeys(VARIANTS, trial)
    tasks = all_of(TaskSplitter(numbering, range(40), VARIANTS), threads, seconds)
    first = [next(place for place, task in enumerate(tasks) if task[0].variant == name) for name in VARIANTS]
    assert [len(tasks[place][0].trials) for place in first] == [FIRST, FIRST]
    known = [sum(len(piece.trials) for piece in task) for task in tasks[first[1] + 1 :]]
    assert all(count == 1 or count * trial <= LONGEST * (1 + 1e-9) for count in known)
    assert all((count + 1) * trial >= SHORTEST * (1 - 1e-9) for count in known[:-1])


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(1, 9)), min_size=1, max_size=6))
def test_halves(asked):
    pieces = [TrialSpan(shard, VARIANTS[shard % 2], range(10 * shard, 10 * shard + count)) for shard, count in asked]
    actual = halve(pieces)
    sizes = [sum(len(piece.trials) for piece in half) for half in actual]
    assert max(sizes) - min(sizes) <= 1
    assert len(actual) == min(2, sum(sizes))

    def flown(parts):
        return [(piece.shard, piece.variant, trial) for piece in parts for trial in piece.trials]

    assert flown([piece for half in actual for piece in half]) == flown(pieces)
