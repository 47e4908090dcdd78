"""Variational genetic algorithm on a cheap problem: search for a known formula.

Truth: the formula; independence of a search from early rejection and known laws; invariants of a population.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from perilune.analysis.design.laws.law import NetworkOperator, find_law, read_law
from perilune.analysis.design.synthesis.candidate import Phenotype
from perilune.analysis.design.synthesis.genetic import Search, SearchState
from perilune.analysis.design.synthesis.search_settings import SearchSettings
from tests.design.synthesis.test_pareto import dominates
from tests.support.laws.evaluation import evaluate_tree
from tests.support.laws.regression import POINTS, TOLERANCE, FormulaEvaluator, near
from tests.support.lengths import either

BASIC = read_law(find_law("diveev_2013_basic"))
SMALL = SearchSettings(population=32, generations=either(12, 11), crossovers=20, elites=4, renewal=5, stop=False)


def search(seed, settings=SMALL, evaluator=None):
    random = np.random.Generator(np.random.PCG64(seed))
    state = SearchState(random=random, bases=[BASIC.matrix], code=settings.coding.encode(BASIC.q))
    return Search(settings, evaluator or FormulaEvaluator(near), state)


def finished(*arguments, **keywords):
    actual = search(*arguments, **keywords)
    while not actual.is_over:
        actual.advance()
    return actual


@pytest.mark.parametrize("seed", range(either(3, 1)))
def test_it_finds_a_formula(seed):
    """Within some thousand evaluations, where one of 420 variations and three parameters have to be found."""
    actual = finished(seed, SearchSettings(population=64, generations=60, crossovers=48))
    assert actual.state.succeeded
    chosen = actual.choose()
    assert chosen.evaluation.successes == chosen.evaluation.flown == FormulaEvaluator.trials
    law = actual.law(chosen)
    for point in POINTS:
        u1, u2 = evaluate_tree(NetworkOperator("", law.matrix, law.q, "true"), *point)
        assert (u1, u2) == pytest.approx(near(*point), abs=TOLERANCE)
    assert actual.state.evaluations == len(actual.state.known) == actual.evaluator.laws
    assert actual.state.flights == actual.evaluator.points


first = cache(finished)  # by seed; what comes of a search is looked at, not changed


@pytest.mark.parametrize("seed", range(either(3, 1)))
def test_giving_up_early_does_not_change_the_search(seed):
    hasty, thorough = first(seed), finished(seed, evaluator=FormulaEvaluator(near, hasty=False))
    assert hasty.state.population == thorough.state.population
    assert hasty.state.front == thorough.state.front
    assert hasty.state.champion == thorough.state.champion
    assert hasty.state.evaluations == thorough.state.evaluations
    assert hasty.state.flights < thorough.state.flights
    assert hasty.state.random.bit_generator.state == thorough.state.random.bit_generator.state


def test_the_same_seed_gives_the_same_search_and_another_another():
    assert finished(0).state.history == first(0).state.history
    assert first(0).state.history != first(1).state.history


def test_the_front_is_the_pareto_set_of_all_that_was_let_past_the_bar():
    thorough = finished(4, evaluator=FormulaEvaluator(near, hasty=False))
    everything = {evaluation.objectives for evaluation in thorough.state.known.values()}
    best = {point for point in everything if not any(dominates(other, point) for other in everything)}
    assert {member.evaluation.objectives for member in thorough.state.front} == best
    assert len(thorough.state.front) == len(best)


def test_a_population_only_gets_better_between_renewals():
    actual = search(3)
    actual.advance()
    before, replaced = {member.evaluation.objectives for member in actual.state.population}, 0
    while actual.state.generation < SMALL.renewal - 1:
        actual.advance()
        after = {member.evaluation.objectives for member in actual.state.population}
        lost = before - after
        replaced += len(lost)
        assert all(any(dominates(other, point) for other in after) for point in lost)
        assert len(actual.state.population) == SMALL.population
        before = after
    assert replaced > 0


def test_the_first_candidate_is_the_basic_solution():
    actual = search(0)
    actual.advance()
    first = actual.state.population[0]
    assert actual.law(first) == Phenotype(BASIC.matrix, BASIC.q)
    assert len(actual.state.population) == SMALL.population
    assert actual.state.generation == 0


def test_a_renewal_takes_the_chosen_law_as_basis_and_keeps_the_elites():
    actual = search(5)
    while actual.state.generation < SMALL.renewal - 1:
        actual.advance()
    calls = []
    renew = actual._renew

    def watched():
        calls.append((actual.law(actual.choose()), list(actual.state.population)))
        renew()

    actual._renew = watched
    actual.advance()
    ((chosen, before),) = calls
    state = actual.state
    assert len(state.bases) == 2
    fresh = [member for member in state.population if member.genes.basis == 1]
    assert actual.law(fresh[0]) == chosen
    retained = [member for member in state.population if member in before]
    assert len(retained) >= SMALL.elites
    assert len(fresh) == SMALL.population - SMALL.elites
    points = [member.evaluation.objectives for member in before]
    for member in retained[: SMALL.elites]:
        worse = sum(dominates(point, member.evaluation.objectives) for point in points)
        assert worse <= sorted(sum(dominates(a, b) for a in points) for b in points)[SMALL.elites - 1]


def test_no_law_is_evaluated_twice():
    recorded = set()

    class Watched(FormulaEvaluator):
        def evaluate(self, tasks, bar):
            for task in tasks:
                assert (task.law.key, task.known.flown) not in recorded
                recorded.add((task.law.key, task.known.flown))
            return super().evaluate(tasks, bar)

    finished(6, evaluator=Watched(near))


def test_laws_that_differ_in_nothing_that_counts_share_a_key():
    used = Phenotype(BASIC.matrix, (1.0, 2.0, 3.0))
    assert used.key != Phenotype(BASIC.matrix, (1.0, 2.0, 3.5)).key
    without_q3 = [list(row) for row in BASIC.matrix]
    without_q3[5][8] = 0
    matrix = tuple(map(tuple, without_q3))
    assert Phenotype(matrix, (1.0, 2.0, 3.0)).key == Phenotype(matrix, (1.0, 2.0, 3.5)).key


def test_stop_ends_the_search_at_the_first_law_without_failures():
    settings = replace(SMALL, stop=True)
    actual = search(0, settings, FormulaEvaluator(lambda theta, d: (1e9, 1e9)))
    easy = search(0, settings, FormulaEvaluator(lambda theta, d: evaluate_tree(BASIC, theta, d)))
    actual.advance()
    easy.advance()
    assert not actual.is_over
    assert easy.is_over
    assert easy.state.succeeded
    assert easy.law(easy.choose()).matrix == BASIC.matrix


def test_objectives_out_of_reach_are_infinite_and_lose():
    class Failing(FormulaEvaluator):
        def _evaluate(self, task, bar):
            actual = super()._evaluate(task, None)
            return actual if task.law.q == BASIC.q else actual._replace(objectives=(np.inf, np.inf))

    actual = search(1, replace(SMALL, generations=2), Failing(near))
    while not actual.is_over:
        actual.advance()
    assert actual.choose().evaluation.objectives < (1e9, 1e9)
    assert all(member.evaluation.objectives < (1e9, 1e9) for member in actual.state.front)
