"""Reference trajectory of a system's FMU, simulated with the FMUs of its components and equal to the last bit."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence

from ....fmus_src.evidence.check import TIME
from ....fmus_src.evidence.experiments import Experiment, write_experiments
from ....fmus_src.evidence.manifest import CSV, EXPERIMENTS, FOLDER, Related
from ....fmus_src.evidence.recorded import write_table
from ...runtime.process.opening import open_simulation
from .fmu_variables import FmuVariable
from .model import ChoiceProgram

MOST_ROWS = 500
OUTPUTS, EXPERIMENT = "outputs.csv", "outputs.exp"


def find_default_program(programs: Sequence[ChoiceProgram], defaults: Mapping[str, int]) -> ChoiceProgram:
    """Return the program of the default choice; ``defaults`` are the numbers, from 1, of the candidates by slot."""
    return next(program for program in programs if program.choice.numbers == tuple(defaults.values()))


def record_reference(
    name: str, program: ChoiceProgram, declared: list[FmuVariable]
) -> tuple[dict[str, bytes], list[Related]]:
    """Record outputs and exposed signals with all parameters and inputs at their start values.

    Signals that exist only with other candidates are omitted; if no signals remain, no files are returned.
    """
    visible = [each.name for each in declared if each.causality in ("output", "local")]
    visible = [each for each in visible if each in program.layout.slots]
    prepared = program.prepared
    every = max(1, math.ceil(prepared.steps / MOST_ROWS))
    with open_simulation(prepared, requested=visible) as simulation:
        flight = simulation.advance(-1, prepared.steps, every=every)
        signals = [each for each in visible if each in flight.signals]
        columns = [flight.time.tolist(), *(flight.signals[each].tolist() for each in signals)]
    if signals and not columns[0]:
        warnings.warn(f"no reference trajectory: the system fails at its start: {flight.message}", stacklevel=2)
    if not signals or not columns[0]:
        return {}, []
    types = {each.name: each.type for each in declared}
    texts = [[_text(number, "Real") for number in columns[0]]]
    texts += [
        [_text(number, types[each]) for number in column] for each, column in zip(signals, columns[1:], strict=True)
    ]
    experiment = Experiment(
        "outputs",
        "outputs and exposed signals of the system simulated with the FMUs of its components, bit by bit",
        (columns[0][0], columns[0][-1]),
        prepared.step,
        OUTPUTS,
    )
    files = {
        f"{FOLDER}/{OUTPUTS}": write_table([TIME, *signals], zip(*texts, strict=True)),
        f"{FOLDER}/{EXPERIMENT}": write_experiments(name, [experiment]),
    }
    return files, [
        Related(f"{FOLDER}/{OUTPUTS}", "result", CSV, experiment.description),
        Related(
            f"{FOLDER}/{EXPERIMENT}", "experiment/validation", EXPERIMENTS, "experiment that reproduces the trajectory"
        ),
    ]


def _text(number: float, type_name: str) -> str:
    return repr(number) if type_name == "Real" else str(int(number))
