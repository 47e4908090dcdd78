"""Variables with a meaning fixed by their names, in the life cycle of an FMU, a simulation, a campaign or a study.

A block declares them like any other variable; its FMU contains them under the same names.
"""

from __future__ import annotations

from dataclasses import dataclass

SAMPLE_PERIOD = "sample_period"
START_TIME = "start_time"
INTEGRATION_STEPS = ("longest_step", "internal_step")  # the first one that a block declares is used
SEED, STREAM = "seed", "stream"
STATUS = "status"
FINISHED = "finished"
FROZEN = "frozen_"  # prefix of an output's name


@dataclass(frozen=True)
class Role:
    """Reserved name of a variable, with the declaration that it requires and the variable's effect.

    ``is_in_life_cycle`` is True if the life cycle of every FMU uses the variable, which must then be a single number.
    """

    name: str
    declared: str
    effect: str
    is_in_life_cycle: bool = False


ROLES = (
    Role(
        SAMPLE_PERIOD,
        "Parameter, s",
        "sample period: the block steps at start + k periods; 0: at every communication point",
        True,
    ),
    Role(START_TIME, "State, s", "start time of the simulation, set before `initialize` runs", True),
    Role(
        INTEGRATION_STEPS[1],
        "Parameter, s",
        "longest step of numerical integration; a communication step contains at most 10^6 of them",
        True,
    ),
    Role(INTEGRATION_STEPS[0], "State, s", "the same as a state, in place of `internal_step`", True),
    Role(SEED, "Parameter, Integer", "seed of random numbers; a campaign sets it to its own seed"),
    Role(STREAM, "Parameter, Integer", "random stream; a campaign sets a different one for each trial and component"),
    Role(
        STATUS,
        "Output, Integer or Enumeration",
        "status of the block, 0 if good; the worst status of a simulation is printed and reported",
    ),
    Role(FINISHED, "Output of the system, Boolean", "ends the simulation when it becomes true"),
    Role(f"{FROZEN}NAME", "Parameter", "value at which the output NAME is held in stability studies, if above 0"),
)
LIFE_CYCLE = {role.name: role for role in ROLES if role.is_in_life_cycle}
