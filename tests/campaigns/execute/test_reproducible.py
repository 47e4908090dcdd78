"""The same campaign gives the same bits for any workers, any order of tasks, and in a replay.

Truth: the campaign simulated once in this process, trial by trial in order.
"""

import random

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.flyer import Flyer
from perilune.analysis.campaigns.trials import join_trials
from perilune.analysis.runtime.system.options import SystemOptions
from tests.support.lengths import either

SYSTEM = "lunar_terminal_guidance"
TRIALS = 6
COMPARE = {"guidance": ["analytic_guidance", "astar_modified_guidance"]}
pytestmark = pytest.mark.usefixtures("fmus")


def flown(flavour="native", **options):
    options = {"trials": TRIALS, "workers": 1, "compare": COMPARE} | options
    return perilune.batch(SYSTEM, "noisy", flavour=flavour, **options)


@pytest.fixture(scope="module")
def reference(fmus):
    return flown().table()


def bits(table):
    """Return every column as bytes: NaN equal to NaN, 0.0 different from -0.0."""
    return {
        name: np.asarray(column).tobytes() if str(column.type) == "double" else column.to_pylist()
        for name, column in zip(table.column_names, table.columns, strict=True)
    }


@pytest.mark.parametrize(
    ("flavour", "workers"), [("native", 2), ("native", 3), *either([("python", 1), ("python", 2)], [])]
)
def test_any_number_of_workers_in_either_flavour(reference, flavour, workers):
    assert bits(flown(flavour, workers=workers).table()) == bits(reference)


def test_any_order_of_tasks(reference):
    plan = read_plan(SYSTEM, "noisy", SystemOptions(flavour="native"), trials=TRIALS, compare=COMPARE)
    tasks = [(variant, range(trial, trial + 1)) for variant in COMPARE["guidance"] for trial in range(TRIALS)]
    random.Random(3).shuffle(tasks)
    actual = {variant: [] for variant in COMPARE["guidance"]}
    flyer = Flyer(plan)
    for variant, trials in tasks:
        actual[variant].append(flyer.fly(variant, trials))
    flyer.close()
    rows = reference.to_pylist()
    for number, (variant, parts) in enumerate(actual.items()):
        column = join_trials(parts)
        expected = rows[number * TRIALS : (number + 1) * TRIALS]
        assert column.trial.tolist() == list(range(TRIALS))
        assert column.statuses == [row["status"] for row in expected], variant
        assert column.metrics
        assert column.final
        for name, values in column.metrics.items():
            assert values.tobytes() == np.array([row[f"metric.{name}"] for row in expected]).tobytes()
        for name, values in column.final.items():
            assert values.tobytes() == np.array([row[f"final.{name}"] for row in expected]).tobytes()


def test_more_trials_leave_the_first_ones_as_they_are(reference):
    fewer = flown(trials=4).table().to_pylist()
    rows = reference.to_pylist()
    assert [row for row in rows if row["trial"] < 4] == fewer


def test_replay_is_the_trial_to_the_last_bit(reference):
    plan = read_plan(SYSTEM, "noisy", SystemOptions(flavour="native"), trials=TRIALS, compare=COMPARE)
    flyer = Flyer(plan)
    rows = {(row["variant"], row["trial"]): row for row in reference.to_pylist()}
    for variant, trial in (("analytic_guidance", 5), ("astar_modified_guidance", 0), ("analytic_guidance", 5)):
        result, actual = flyer.replay(variant, trial)
        row = rows[variant, trial]
        assert (actual.status, actual.success, actual.end_time) == (row["status"], row["success"], row["end_time"])
        assert {f"metric.{name}": value for name, value in actual.metrics.items()} == {
            name: value for name, value in row.items() if name.startswith("metric.")
        }
        assert result["plant.position[1]"][-1] == row["final.plant.position[1]"]
        assert len(result.signals) > 60
    flyer.close()


def test_every_trial_and_component_has_its_stream_the_same_for_every_variant():
    plan = read_plan(SYSTEM, "noisy", SystemOptions(), trials=50, compare=COMPARE)
    known = set()
    for variant in plan.campaign.variants():
        prepared = plan.prepare(variant)
        actual = [plan.parameters(prepared, trial) for trial in range(50)]
        streams = {(row["navigation.seed"], row["navigation.stream"]) for row in actual}
        assert len(streams) == 50
        known.add(frozenset(streams))
    assert len(known) == 1


def test_variants_face_the_same_noise_and_trials_do_not():
    """First estimates are the truth with the stream's first errors: equal across guidances, not across trials."""
    plan = read_plan(SYSTEM, "noisy", SystemOptions(stop_time=1.0, flavour="native"), trials=6, compare=COMPARE)
    flyer = Flyer(plan)
    errors = {}
    for variant in COMPARE["guidance"]:
        for trial in range(6):
            flight, _ = flyer.replay(variant, trial)
            error = flight["navigation.estimated_position[1]"] - flight["plant.position[1]"]
            errors[variant, trial] = error[0]
    flyer.close()
    first, second = COMPARE["guidance"]
    assert all(errors[first, trial] == errors[second, trial] for trial in range(6))
    assert len({errors[first, trial] for trial in range(6)}) == 6
    assert all(0 < abs(error) < 600 for error in errors.values())  # 1 sigma is 100 m


def test_another_seed_draws_and_perturbs_anew(reference):
    other = flown(seed=1, trials=3).table().to_pylist()
    rows = reference.to_pylist()
    for name in ("draw.speed", "metric.position_error"):
        assert not {row[name] for row in other} & {row[name] for row in rows}

    def seed_of_noise(seed):
        plan = read_plan(SYSTEM, "noisy", SystemOptions(), trials=1, seed=seed, compare=COMPARE)
        return plan.parameters(plan.prepare(plan.campaign.variants()[0]), 0)["navigation.seed"]

    assert seed_of_noise(1) == 1
    assert seed_of_noise(2) == 2
