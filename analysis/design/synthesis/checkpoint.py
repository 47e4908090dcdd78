"""State of a search as JSON, from which it can be resumed with the same result."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ....common.atomic import write_atomically
from ....common.errors import InputError
from .candidate import Candidate, Evaluation, Genes
from .genetic import SearchState
from .variations import Variation

FORMAT, VERSION = "perilune-synthesis-checkpoint", 1
CandidateEntry = tuple[int, Sequence[Sequence[int]], int, str]  # genes, key of the law
REMEDY = "start a new search in another folder"


def write_checkpoint(path: Path, state: SearchState, facts: Mapping[str, object]) -> None:
    """Write the state, with the ``facts`` on which it depends."""
    document = {"format": FORMAT, "version": VERSION, "facts": facts, "state": state_document(state)}
    write_atomically(path, json.dumps(document, allow_nan=False).encode())


def read_checkpoint(path: Path, facts: Mapping[str, object]) -> SearchState:
    """Return the state in a file that was written with the same facts. Raises InputError."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(document, dict) or document.get("format") != FORMAT or document.get("version") != VERSION:
            raise InputError(path, "format", "not a checkpoint that this version can read", REMEDY)
        stored = document["facts"]
        for name, value in facts.items():
            if name not in stored or stored[name] != json.loads(json.dumps(value)):
                raise InputError(
                    path, name, "differs from its value at the start of the search", f"restore that value, or {REMEDY}"
                )
        return state_of(document["state"])
    except FileNotFoundError as error:
        raise InputError(path, "", "not found", "leave out `resume` to begin a search") from error
    except InputError:
        raise
    except (ValueError, TypeError, KeyError, IndexError, AttributeError) as error:
        raise InputError(path, "", f"damaged: {type(error).__name__} {error}", REMEDY) from error


def state_document(state: SearchState) -> dict[str, object]:
    """Return a state as JSON; infinite objectives are null."""
    return {
        "random": state.random.bit_generator.state,
        "bases": state.bases,
        "code": state.code,
        "generation": state.generation,
        "evaluations": state.evaluations,
        "flights": state.flights,
        "population": [_candidate(candidate) for candidate in state.population],
        "front": [_candidate(candidate) for candidate in state.front],
        "champion": None if state.champion is None else _candidate(state.champion),
        "known": {key: ([*map(finite_or_none, sums)], *counts) for key, (sums, *counts) in state.known.items()},
        "history": [{name: finite_or_none(value) for name, value in line.items()} for line in state.history],
        "succeeded": state.succeeded,
    }


def state_of(document: Mapping[str, Any]) -> SearchState:
    random = np.random.Generator(np.random.PCG64())
    random.bit_generator.state = document["random"]
    known = {key: Evaluation(tuple(map(_value, sums)), *counts) for key, (sums, *counts) in document["known"].items()}
    champion = document["champion"]
    return SearchState(
        random=random,
        bases=[tuple(tuple(row) for row in basis) for basis in document["bases"]],
        code=document["code"],
        generation=document["generation"],
        evaluations=document["evaluations"],
        flights=document["flights"],
        population=[_candidate_of(entry, known) for entry in document["population"]],
        front=[_candidate_of(entry, known) for entry in document["front"]],
        champion=None if champion is None else _candidate_of(champion, known),
        known=known,
        history=[{name: _value(value) for name, value in line.items()} for line in document["history"]],
        succeeded=document["succeeded"],
    )


def finite_or_none(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _value(number: float | None) -> float:
    return math.inf if number is None else number


def _candidate(candidate: Candidate) -> CandidateEntry:
    return *candidate.genes, candidate.key


def _candidate_of(entry: CandidateEntry, known: Mapping[str, Evaluation]) -> Candidate:
    basis, variations, code, key = entry
    return Candidate(Genes(basis, tuple(Variation(*each) for each in variations), code), key, known[key])
