"""The variational genetic algorithm on a cheap problem: finding a known formula.

Truth: the formula itself; what must not change a search (evaluators that give up early, knowing laws
already); what a population must keep.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from perilune.analysis.design.laws.expression_tree import evaluate_tree
from perilune.analysis.design.laws.law import Law, named_law, read_law
from perilune.analysis.design.synthesis.candidate import Phenotype
from perilune.analysis.design.synthesis.genetic import Search, SearchState
from perilune.analysis.design.synthesis.search_settings import SearchSettings
from tests.design.synthesis.test_pareto import dominates
from tests.support.laws.regression import POINTS, TOLERANCE, FormulaEvaluator, near
from tests.support.lengths import either

BASIC = read_law(named_law("diveev_2013_basic"))
SMALL = SearchSettings(population=32, generations=12, crossovers=20, elites=4, renewal=5, stop=False)


def search(seed, settings=SMALL, evaluator=None):
    random = np.random.Generator(np.random.PCG64(seed))
    state = SearchState(random=random, bases=[BASIC.matrix], code=settings.coding.encode(BASIC.q))
    return Search(settings, evaluator or FormulaEvaluator(near), state)


def finished(*arguments, **keywords):
    found = search(*arguments, **keywords)
    while not found.is_over:
        found.advance()
    return found


@pytest.mark.parametrize("seed", range(either(3, 1)))
def test_it_finds_a_formula(seed):
    """Within some thousand evaluations, where one of 420 variations and three parameters have to be found."""
    found = finished(seed, SearchSettings(population=64, generations=60, crossovers=48))
    assert found.state.succeeded
    chosen = found.chosen()
    assert chosen.evaluation.successes == chosen.evaluation.flown == FormulaEvaluator.trials
    law = found.law(chosen)
    for point in POINTS:
        u1, u2 = evaluate_tree(Law("", law.matrix, law.q, "true"), *point)
        assert (u1, u2) == pytest.approx(near(*point), abs=TOLERANCE)
    assert found.state.evaluations == len(found.state.known) == found.evaluator.laws
    assert found.state.flights == found.evaluator.points


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
    found = search(3)
    found.advance()
    before, replaced = {member.evaluation.objectives for member in found.state.population}, 0
    while found.state.generation < SMALL.renewal - 1:
        found.advance()
        after = {member.evaluation.objectives for member in found.state.population}
        lost = before - after
        replaced += len(lost)
        assert all(any(dominates(other, point) for other in after) for point in lost)
        assert len(found.state.population) == SMALL.population
        before = after
    assert replaced > 0


def test_the_first_candidate_is_the_basic_solution():
    found = search(0)
    found.advance()
    first = found.state.population[0]
    assert found.law(first) == Phenotype(BASIC.matrix, BASIC.q)
    assert len(found.state.population) == SMALL.population
    assert found.state.generation == 0


def test_a_renewal_takes_the_chosen_law_as_basis_and_keeps_the_elites():
    found = search(5)
    while found.state.generation < SMALL.renewal - 1:
        found.advance()
    calls = []
    renew = found._renew

    def watched():
        calls.append((found.law(found.chosen()), list(found.state.population)))
        renew()

    found._renew = watched
    found.advance()
    ((chosen, before),) = calls
    state = found.state
    assert len(state.bases) == 2
    fresh = [member for member in state.population if member.genes.basis == 1]
    assert found.law(fresh[0]) == chosen
    kept = [member for member in state.population if member in before]
    assert len(kept) >= SMALL.elites
    assert len(fresh) == SMALL.population - SMALL.elites
    points = [member.evaluation.objectives for member in before]
    for member in kept[: SMALL.elites]:
        worse = sum(dominates(point, member.evaluation.objectives) for point in points)
        assert worse <= sorted(sum(dominates(a, b) for a in points) for b in points)[SMALL.elites - 1]


def test_no_law_is_evaluated_twice():
    seen = set()

    class Watched(FormulaEvaluator):
        def evaluate(self, tasks, bar):
            for task in tasks:
                assert (task.law.key, task.known.flown) not in seen
                seen.add((task.law.key, task.known.flown))
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
    found = search(0, settings, FormulaEvaluator(lambda theta, d: (1e9, 1e9)))
    easy = search(0, settings, FormulaEvaluator(lambda theta, d: evaluate_tree(BASIC, theta, d)))
    found.advance()
    easy.advance()
    assert not found.is_over
    assert easy.is_over
    assert easy.state.succeeded
    assert easy.law(easy.chosen()).matrix == BASIC.matrix


def test_objectives_out_of_reach_are_infinite_and_lose():
    class Failing(FormulaEvaluator):
        def _evaluate(self, task, bar):
            found = super()._evaluate(task, None)
            return found if task.law.q == BASIC.q else found._replace(objectives=(np.inf, np.inf))

    found = search(1, replace(SMALL, generations=2), Failing(near))
    while not found.is_over:
        found.advance()
    assert found.chosen().evaluation.objectives < (1e9, 1e9)
    assert all(member.evaluation.objectives < (1e9, 1e9) for member in found.state.front)
