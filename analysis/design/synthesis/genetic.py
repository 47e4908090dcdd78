"""Variational genetic algorithm: a population of variations of a basic solution, in Pareto order.

Source: Diveev 2010 and Diveev, Pupkov and Sofronova 2013 for the search over variations, Gray code, parents whose
probability to mate decreases with the number of candidates that dominate them, four children that replace the worst
members, and the renewal of the basis. Two parents dominated by L1 and L2 candidates mate with the larger probability of
(1 + alpha L)/(1 + L). Added here: variations are sampled where they apply, after the earlier ones; half of the random
parameters are uniform, half differ from the basis in up to three bits; 16 couples are evaluated together; children with
the same objectives as a member are rejected; ties are decided by the distance from the ideal point in units of the
Pareto set's extent; elites keep their basis.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..laws.law import Matrix
from .candidate import (
    AdmissionThreshold,
    Candidate,
    Evaluation,
    EvaluationTask,
    Evaluator,
    Genes,
    Phenotype,
    cross,
    mutate,
    phenotype,
    random_genes,
)
from .pareto import ParetoOrder, dominators, is_dominated
from .search_settings import SearchSettings
from .variations import NO_VARIATION, apply_variations

BROOD = 16  # couples whose children are evaluated together: fixed, so that workers do not change the result


@dataclass
class SearchState:
    """State of a search without its settings, sufficient to resume it."""

    random: np.random.Generator
    bases: list[Matrix]
    code: int  # code of the basic solution
    generation: int = 0
    evaluations: int = 0
    flights: int = 0
    population: list[Candidate] = field(default_factory=list)
    known: dict[str, Evaluation] = field(default_factory=dict)
    front: list[Candidate] = field(default_factory=list)  # Pareto set of all evaluated candidates
    champion: Candidate | None = None  # candidate with most successes
    history: list[dict[str, float]] = field(default_factory=list)
    succeeded: bool = False


class Search:
    """Search for laws; call `advance` until it `is_over`."""

    def __init__(self, settings: SearchSettings, evaluator: Evaluator, state: SearchState) -> None:
        self.settings = settings
        self.evaluator = evaluator
        self.state = state
        self.coding = settings.coding

    @property
    def is_over(self) -> bool:
        return self.state.succeeded or self.state.generation >= self.settings.generations

    def advance(self) -> None:
        """Evaluate the first population or the next generation, which is cut short if the search ends."""
        state = self.state
        if not state.population:
            self._start()
        else:
            left = self.settings.crossovers
            while left > 0 and not state.succeeded:
                self._breed(min(left, BROOD))
                left -= BROOD
            state.generation += 1
            if not self.is_over and state.generation % self.settings.renewal == 0:
                self._renew()
        self._add_to_history()

    def _start(self) -> None:
        """Evaluate the first population: the encoded basic solution and, unless it suffices, random variations."""
        state = self.state
        basic = Genes(0, (NO_VARIATION,) * self.settings.variations, state.code)
        state.population = self._evaluate([basic])
        if not self.is_over:
            state.population += self._evaluate(self._random(0, state.code, self.settings.population - 1))

    def choose(self) -> Candidate:
        """Return the best candidate: most successes, then the best compromise of the Pareto set."""
        state = self.state
        assert state.champion is not None  # set by the first evaluation
        maximum = state.champion.evaluation.successes
        order = ParetoOrder(objectives_of(state.front)).order()
        best = [state.front[place] for place in order if state.front[place].evaluation.successes == maximum]
        return best[0] if best else state.champion

    def law(self, candidate: Candidate) -> Phenotype:
        return phenotype(candidate.genes, self.state.bases, self.coding)

    def _random(self, basis: int, code: int, count: int) -> list[Genes]:
        random, bases, variations = self.state.random, self.state.bases, self.settings.variations
        return [random_genes(random, basis, bases, code, variations, self.coding) for _ in range(count)]

    def _breed(self, couples: int) -> None:
        """Breed children of some couples, evaluated together and then inserted one after another."""
        random, settings = self.state.random, self.settings
        order = ParetoOrder(objectives_of(self.state.population))
        bar = AdmissionThreshold(order, order.standing(order.objectives[order.worst()]))
        children: list[Genes] = []
        for _ in range(couples):
            pair = random.integers(len(self.state.population), size=2)
            likely = max((1.0 + settings.crossover * rank) / (1.0 + rank) for rank in order.ranks[pair])
            if random.random() < likely:
                first, second = (self.state.population[place].genes for place in pair)
                children += cross(random, first, second, self.coding)
        grown = [
            mutate(random, child, self.state.bases, self.coding) if random.random() < settings.mutation else child
            for child in children
        ]
        for candidate in self._evaluate(grown, bar):
            if not bar.rejects(candidate.evaluation.objectives) and self._insert(candidate, order):
                order = ParetoOrder(objectives_of(self.state.population))

    def _insert(self, candidate: Candidate, order: ParetoOrder) -> bool:
        """Replace the worst member by a candidate unless it is no better or has the same objectives as a member."""
        point = np.array(candidate.evaluation.objectives)
        worst = order.worst()
        twin = np.any(np.all(order.objectives == point, axis=1))
        if twin or order.standing(point) >= order.standing(order.objectives[worst]):
            return False
        self.state.population[worst] = candidate
        return True

    def _renew(self) -> None:
        """Replace the basis by the best candidate; elites remain, the other members are redrawn."""
        state = self.state
        best = self.choose().genes
        state.bases.append(apply_variations(state.bases[best.basis], best.variations))
        basis = len(state.bases) - 1
        order = ParetoOrder(objectives_of(state.population)).order()
        elites = [state.population[place] for place in order[: self.settings.elites]]
        basic = Genes(basis, (NO_VARIATION,) * self.settings.variations, best.code)
        others = self._random(basis, best.code, self.settings.population - len(elites) - 1)
        state.population = elites + self._evaluate([basic, *others])

    def _evaluate(self, genes: Sequence[Genes], bar: AdmissionThreshold | None = None) -> list[Candidate]:
        """Evaluate genes, except for known laws and for laws that the bar already rejects on the known trials.

        Only the evaluation of a rejected law is stored, complete or not, so that early rejection does not change the
        search.
        """
        state = self.state
        laws = [phenotype(each, state.bases, self.coding) for each in genes]
        keys = [law.key for law in laws]
        nothing = Evaluation((0.0,) * self.evaluator.objectives, 0, 0)
        tasks: dict[str, EvaluationTask] = {}
        for key, law in zip(keys, laws, strict=True):
            known = state.known.get(key, nothing)
            rejected = known.flown > 0 and bar is not None and bar.rejects(known.objectives)
            if known.flown < self.evaluator.trials and not rejected:
                tasks[key] = EvaluationTask(law, known)
        evaluations = self.evaluator.evaluate(list(tasks.values()), bar)
        for (key, task), evaluation in zip(tasks.items(), evaluations, strict=True):
            state.evaluations += task.known.flown == 0
            state.flights += evaluation.flown - task.known.flown
            state.known[key] = evaluation
        candidates = [Candidate(each, key, state.known[key]) for each, key in zip(genes, keys, strict=True)]
        for candidate in candidates:
            if bar is None or not bar.rejects(candidate.evaluation.objectives):
                self._update_best(candidate)
        return candidates

    def _update_best(self, candidate: Candidate) -> None:
        """Update the Pareto set of all candidates, and the candidate with most successes."""
        state, evaluation = self.state, candidate.evaluation
        point = np.array(evaluation.objectives)
        objectives = objectives_of(state.front)
        if not state.front or not (dominators(objectives, point) or np.any(np.all(objectives == point, axis=1))):
            beaten = is_dominated(objectives, point) if state.front else np.zeros(0, dtype=bool)
            stay = [member for member, out in zip(state.front, beaten, strict=True) if not out]
            state.front = [*stay, candidate]
        best = state.champion
        if (
            best is None
            or evaluation.successes > best.evaluation.successes
            or (
                evaluation.successes == best.evaluation.successes
                and is_dominated(np.array([best.evaluation.objectives]), point)[0]
            )
        ):
            state.champion = candidate
        state.succeeded |= self.settings.stop and evaluation.successes == self.evaluator.trials

    def _add_to_history(self) -> None:
        """Add an entry to the history."""
        state = self.state
        assert state.champion is not None
        minimum = objectives_of(state.front).min(axis=0)
        state.history.append(
            {
                "generation": state.generation,
                "evaluations": state.evaluations,
                "flights": state.flights,
                "front": len(state.front),
                "successes": state.champion.evaluation.successes,
                **{f"least_{index + 1}": value for index, value in enumerate(minimum.tolist())},
            }
        )


def objectives_of(candidates: Sequence[Candidate]) -> np.ndarray:
    return np.array([candidate.evaluation.objectives for candidate in candidates])
