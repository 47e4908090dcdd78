"""Trials of an FMU in several importers, compared with FMPy."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

import fmpy

from perilune.fmus_src.catalogue import catalogue

from .masters import Flight
from .worker import MARK

STEPS = 32
STEP = 1.0 / 16.0  # s: importers add steps up or multiply them, to the same bits where these are exact
CLOSE = 1e-9  # relative, where the FMU has an internal step, which may differ from STEP
TIMEOUT = 120.0


@dataclass(frozen=True)
class Outcome:
    """The end of an FMU's trial in an importer; ``problem`` is empty where it gave the values of FMPy."""

    master: str
    fmu: str
    problem: str


def scalar_outputs(fmu: Path) -> list[str]:
    """Return the names of the scalar Real outputs of an FMU."""
    description = fmpy.read_model_description(str(fmu), validate=False)
    return [
        variable.name
        for variable in description.modelVariables
        if variable.causality == "output" and variable.type in ("Real", "Float64") and not variable.dimensions
    ]


def system_step(fmu: Path) -> float | None:
    """Return the internal step (s) of one FMU of a system, of which communication steps are multiples."""
    experiment = fmpy.read_model_description(str(fmu), validate=False).defaultExperiment
    is_system = not (catalogue().keys() & {fmu.stem})
    return float(experiment.stepSize) if is_system and experiment is not None and experiment.stepSize else None


def fly(master: str, fmu: Path, flight: Flight) -> dict[str, float]:
    """Return the outputs at the end of a flight. Raises RuntimeError with the importer's last line."""
    command = [sys.executable, "-m", "tests.importers.worker", master, str(fmu), json.dumps(asdict(flight))]
    done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT)
    lines = [line.removeprefix(MARK) for line in done.stdout.splitlines() if line.startswith(MARK)]
    if done.returncode or not lines:
        said = (done.stderr.strip() or done.stdout.strip() or f"status {done.returncode}").splitlines()
        raise RuntimeError(said[-1][:200])
    return {name: float.fromhex(text) for name, text in json.loads(lines[-1]).items()}


def agree(number: float, truth: float, tolerance: float) -> bool:
    """Return True if two values are the same, or as near as a relative tolerance allows."""
    return (
        number == truth or abs(number - truth) <= tolerance * abs(truth) or (math.isnan(number) and math.isnan(truth))
    )


def try_importers(fmu: Path, masters: Iterable[str]) -> list[Outcome]:
    """Return how each importer does with an FMU."""
    step = system_step(fmu)
    flight = Flight(STEP if step is None else step, STEPS, tuple(scalar_outputs(fmu)))
    truth, tolerance = fly("FMPy", fmu, flight), 0.0 if step is None else CLOSE
    outcomes = []
    for master in masters:
        problem = ""
        try:
            values = truth if master == "FMPy" else fly(master, fmu, flight)
            other = next((name for name in truth if not agree(values[name], truth[name], tolerance)), None)
            problem = "" if other is None else f"{other} is {values[other]!r}, with FMPy {truth[other]!r}"
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            problem = str(error)
        outcomes.append(Outcome(master, fmu.name, problem))
    return outcomes
