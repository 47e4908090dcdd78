"""Trials per second of a lunar landing: Basilisk's Monte Carlo controller and `perilune batch`, on the same samples.

    python -m benchmarks.basilisk PYTHON

PYTHON is the absolute path of the interpreter of the cross-checks' environment, in which Basilisk is installed as well
(`make bench-basilisk`). Each contestant runs a small and a large number of trials; the difference of their times is the
cost of trials without start-up. The final states of the first trials must agree.
"""

import json
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack, chdir
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

import perilune

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "benchmarks" / "basilisk"
FAST, SLOW = (40, 1040), (4, 24)  # numbers of trials of a measurement
AGREEMENT = 0.01  # m, m/s; the plants hold thrust differently within a step
NO_LAGS = {"plant.thrust_lag": 0.0, "allocation.thrust_lead": 0.0, "allocation.direction_lead": 0.0}
PLANTS = {
    "here": ({}, {"plant.direction_response": 0.0, "plant.slew_rate_limit": 0.0}),
    "here, Basilisk's plant": (
        {"plant": "basilisk_moon_lander"},
        {"plant.direction_response": 1e-3, "plant.slew_rate_limit": 1e6},
    ),
}
VECTORS = {"hub.r_CN_NInit": "plant.initial_position", "hub.v_CN_NInit": "plant.initial_velocity"}
MOON_RADIUS = 1.7374e6  # m


def run_perilune(folder: Path, plant: str, trials: int, workers: int) -> tuple[float, list[list[float]]]:
    """Simulate a batch with Perilune.

    Returns the time (s), and the final position (m) and velocity (m/s) of each trial in the landing-site frame.
    """
    use, parameters = PLANTS[plant]
    start = time.perf_counter()
    flown = perilune.batch(
        "lunar_landing",
        FOLDER / "landing.toml",
        trials=trials,
        workers=workers,
        use={"navigation": "ideal_navigation", **use},
        parameters=["ideal.ssv"],
        set=NO_LAGS | parameters,
        output=folder / "here",
        overwrite=True,
    )
    elapsed = time.perf_counter() - start
    rows = flown.table()
    names = [f"metric.{vector}{axis}" for vector in "rv" for axis in "xyz"]
    return elapsed, np.stack([rows[name].to_numpy() for name in names], axis=1).tolist()


def run_basilisk(
    folder: Path, python: str, trials: int, workers: int, *options: str
) -> tuple[float, list[list[float]]]:
    """Simulate the same batch with Basilisk; return the same as `run_perilune`."""
    command = [python, "-W", "ignore", "-m", "benchmarks.basilisk.monte_carlo", str(folder), str(trials), str(workers)]
    done = subprocess.run([*command, *options], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    document = json.loads(done.stdout.splitlines()[-1])
    return document["seconds"], (np.array(document["states"]) - (0, 0, MOON_RADIUS, 0, 0, 0)).tolist()


@dataclass(frozen=True)
class Contestant:
    """Contestant: Perilune with a ``plant``, or Basilisk with ``options``, and its numbers of trials."""

    name: str
    trials: tuple[int, int]
    plant: str | None = None
    options: tuple[str, ...] = ()
    lands: bool = True

    def fly(self, folder: Path, python: str, trials: int, workers: int) -> tuple[float, list[list[float]]]:
        if self.plant is not None:
            return run_perilune(folder, self.plant, trials, workers)
        return run_basilisk(folder, python, trials, workers, *self.options)


CONTESTANTS = (
    Contestant("`perilune batch`", FAST, "here"),
    Contestant("`perilune batch`, Basilisk's plant", SLOW, "here, Basilisk's plant"),
    Contestant("Basilisk's controller", SLOW),
    Contestant("the same without its pause", SLOW, options=("--no-pause",)),
    Contestant("the same without guidance", SLOW, options=("--no-pause", "--unguided"), lands=False),
)


def write_draws(folder: Path) -> None:
    """Write the samples of a campaign as Basilisk's files of initial conditions."""
    (folder / "draws").mkdir()
    for row in pq.read_table(folder / "here" / "draws.parquet").to_pylist():
        document = {}
        for attribute, vector in VECTORS.items():
            elements = [row.get(f"{vector}[{axis}]", 0.0) for axis in (1, 2, 3)]
            centre = MOON_RADIUS if vector == "plant.initial_position" else 0.0
            document[f"craft.{attribute}"] = [[elements[0]], [elements[1]], [elements[2] + centre]]
        (folder / "draws" / f"run{row['trial']}.json").write_text(json.dumps(document))


def main(python: str) -> None:
    print("| contestant | workers | trials a second | largest difference at the end, m or m/s |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary, ExitStack() as stack:
        folder = Path(temporary)
        stack.enter_context(chdir(folder))
        perilune.export(ROOT / "examples" / "basilisk_moon_lander.py")
        _, reference = run_perilune(folder, "here", SLOW[1], 1)
        write_draws(folder)
        for contestant in CONTESTANTS:
            for workers in (1, 2):
                (few, _), (many, states) = (contestant.fly(folder, python, n, workers) for n in contestant.trials)
                rate = (contestant.trials[1] - contestant.trials[0]) / (many - few)
                apart = np.abs(np.array(states)[: len(reference)] - np.array(reference)).max()
                if contestant.lands and apart > AGREEMENT:
                    sys.exit(f"{contestant.name}: not the same landings: {apart:.3g} m or m/s apart at the end")
                difference = f"{apart:.1e}" if contestant.lands else "does not land"
                print(f"| {contestant.name} | {workers} | {rate:.2f} | {difference} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
