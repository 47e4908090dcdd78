"""Results of a synthesis: the Pareto set, the chosen law as a file and a parameter set, and a log."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ....common.atomic import write_atomically
from ..laws.formula import formula
from ..laws.law import NetworkOperator, parameter_set
from .candidate import Candidate
from .checkpoint import finite_or_none
from .genetic import Search
from .synthesis_file import Synthesis

FORMAT, VERSION = "perilune-pareto-set", 2


@dataclass
class SynthesisOutcome:
    """Result of a search, complete or not; ``ended`` is the reason: success, generations or evaluations."""

    synthesis: Synthesis
    search: Search
    provenance: Mapping[str, object]
    ended: str
    folder: Path | None = None  # folder in which the result is stored

    @property
    def law(self) -> NetworkOperator:
        return self._law(self.search.choose())

    def _law(self, candidate: Candidate) -> NetworkOperator:
        law = self.search.law(candidate)
        evaluation = candidate.evaluation
        file = Path(self.synthesis.campaign.file).name
        description = (
            f"Found by {file}, seed {self.provenance['seed']}, from {self.synthesis.basic.name}: "
            f"{self.objectives_text(candidate)}; "
            f"{evaluation.successes} of {evaluation.flown} trials are successes."
        )
        name = f"{Path(file).stem}_{candidate.key[:8]}"
        return NetworkOperator(name, law.matrix, law.q, self.synthesis.basic.exp_saturation, description)

    @property
    def succeeded(self) -> bool:
        """True if every trial succeeds with the chosen law."""
        return self.search.choose().evaluation.successes == self.search.evaluator.trials

    def pareto_set(self) -> list[Candidate]:
        """Return the Pareto set in the order of the first objective."""
        return sorted(self.search.state.front, key=lambda candidate: candidate.evaluation.objectives)

    def objectives(self, candidate: Candidate) -> dict[str, dict[str, float]]:
        """Return the minimised sum over the trials and the mean over the trials for each objective."""
        _, _, flown = evaluation = candidate.evaluation
        sums = zip(self.synthesis.objectives, evaluation.objectives, strict=True)
        return {name: {"sum": value, "mean": value / flown} for name, value in sums}

    def objectives_text(self, candidate: Candidate) -> str:
        """Return the objectives of a candidate as text, for the description of its law."""
        flown = candidate.evaluation.flown
        return ", ".join(
            f"{name} {value['mean']:.6g} per flight ({value['sum']:.6g} over {flown})"
            for name, value in self.objectives(candidate).items()
        )

    def _member(self, candidate: Candidate) -> dict[str, object]:
        objectives = {
            name: {kind: finite_or_none(number) for kind, number in value.items()}
            for name, value in self.objectives(candidate).items()
        }
        return {
            "objectives": objectives,
            "flights": candidate.evaluation.flown,
            "successes": candidate.evaluation.successes,
            "law": self._law(candidate).content(),
        }

    def content(self) -> dict[str, object]:
        """Return the content of pareto.json: provenance, counts, the chosen law and its formula, the Pareto set."""
        state = self.search.state
        return {
            "format": FORMAT,
            "version": VERSION,
            **self.provenance,
            "ended": self.ended,
            "generations": state.generation,
            "evaluations": state.evaluations,
            "flights": state.flights,
            "chosen": self._member(self.search.choose()) | {"formula": formula(self.law)},
            "members": [self._member(candidate) for candidate in self.pareto_set()],
        }

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Write pareto.json, law.json, law.ssv and log.csv."""
        folder = Path(folder)
        text = json.dumps(self.content(), indent=1, allow_nan=False) + "\n"
        write_atomically(folder / "pareto.json", text.encode())
        self.law.write(folder / "law.json")
        write_atomically(folder / "law.ssv", parameter_set(self.law, self.synthesis.component))
        write_log(folder / "log.csv", self.synthesis, self.search)


def write_log(path: Path, synthesis: Synthesis, search: Search) -> None:
    """Write the history, one line per generation, with the smallest sum of each objective so far."""
    names = {f"least_{index}": f"least_sum_of_{name}" for index, name in enumerate(synthesis.objectives, 1)}
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    history = search.state.history
    writer.writerow([names.get(key, key) for key in history[0]])
    writer.writerows(line.values() for line in history)
    write_atomically(path, buffer.getvalue().encode())
