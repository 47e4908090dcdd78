"""Landing in Basilisk's Monte Carlo controller, with initial conditions from files and retained states.

    python -m benchmarks.basilisk.monte_carlo FOLDER TRIALS WORKERS [--no-pause] [--unguided]

FOLDER/draws contains a JSON file per trial. Prints the time of the controller (s) and the final state of each trial.
The controller pauses for a second in every trial that retains data, which --no-pause removes. With --unguided the
lander falls for the same number of steps, without any Python module. Runs in Basilisk's environment.
"""

import json
import os
import sys
import time
from types import SimpleNamespace

import numpy as np
from Basilisk.utilities import macros
from Basilisk.utilities.MonteCarlo.Controller import Controller
from Basilisk.utilities.MonteCarlo.RetentionPolicy import RetentionPolicy

from benchmarks.basilisk.landing import Landing
from crosscheck.basilisk_side import TASK

TYPICAL = 321.0  # s, of a landing


def create() -> object:
    """Return a landing whose initial conditions are set by the controller."""
    simulation = create_unguided()
    simulation.guidance = simulation.landing.guide()
    return simulation


def create_unguided() -> object:
    """Return a landing without guidance."""
    landing = Landing()
    simulation = landing.simulation
    simulation.landing, simulation.craft = landing, landing.craft
    simulation.msgRecList = {"state": landing.craft.scStateOutMsg.recorder()}
    simulation.AddModelToTask(TASK, simulation.msgRecList["state"])
    return simulation


def execute(simulation: object) -> None:
    simulation.landing.run_to_end(simulation.guidance)


def execute_unguided(simulation: object) -> None:
    simulation.InitializeSimulation()
    simulation.ConfigureStopTime(macros.sec2nano(TYPICAL))
    simulation.ExecuteSimulation()


def run(folder: str, trials: int, workers: int, *, guided: bool) -> tuple[float, list[list[float]]]:
    """Run the controller; return its time (s), and final positions (m, from the Moon's centre) and velocities (m/s)."""
    controller = Controller()
    controller.setSimulationFunction(create if guided else create_unguided)
    controller.setExecutionFunction(execute if guided else execute_unguided)
    controller.setExecutionCount(trials)
    controller.setThreadCount(workers)
    controller.setShouldDisperseSeeds(False)
    controller.setShowProgressBar(False)
    controller.setICDir(os.path.join(folder, "draws"))
    controller.setICRunFlag(True)
    controller.setArchiveDir(os.path.join(folder, "archive"))
    policy = RetentionPolicy()
    policy.addMessageLog("state", ["r_CN_N", "v_CN_N"])
    controller.addRetentionPolicy(policy)
    start = time.perf_counter()
    failed = controller.runInitialConditions(list(range(trials)))
    elapsed = time.perf_counter() - start
    if failed:
        raise SystemExit(f"trials failed in Basilisk: {failed}")
    last = []
    for trial in range(trials):
        messages = controller.getRetainedData(trial)["messages"]
        last.append(np.concatenate([messages[f"state.{name}"][-1, 1:] for name in ("r_CN_N", "v_CN_N")]).tolist())
    return elapsed, last


if __name__ == "__main__":
    where, count, processes, *options = sys.argv[1:]
    if "--no-pause" in options:
        sys.modules[Controller.__module__].time = SimpleNamespace(sleep=lambda _: None)
    seconds, states = run(where, int(count), int(processes), guided="--unguided" not in options)
    print(json.dumps({"seconds": seconds, "states": states}))
