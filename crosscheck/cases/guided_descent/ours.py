"""The descent by the system lunar_terminal_guidance."""

import perilune
from crosscheck.cases.guided_descent.case import CASE, GRAVITY, MASS, SPEED, START, TARGET
from crosscheck.perilune_side import table_of
from crosscheck.table import Table


def simulate(step: float) -> Table:
    """Simulate guidance, allocation and plant in closed loop."""
    flight = perilune.simulate(
        "lunar_terminal_guidance",
        step=step,
        stop_time=CASE.duration,
        use={"navigation": "ideal_navigation"},
        set={
            "plant.initial_position": list(START),
            "plant.initial_velocity": list(SPEED),
            "plant.initial_mass": MASS,
            "plant.gravity": GRAVITY,
            "plant.internal_step": step,
            "guidance.gravity": GRAVITY,
            "guidance.target_position": list(TARGET),
        },
    )
    return table_of(flight, {"position": "plant.position", "velocity": "plant.velocity"})
