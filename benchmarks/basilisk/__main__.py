"""Trials a second of a lunar landing: Basilisk's Monte Carlo controller and `perilune batch`, on the same draws.

    python -m benchmarks.basilisk PYTHON

PYTHON is the absolute path of the interpreter of the cross-checks' environment; Basilisk is installed in this one, too
(`make bench-basilisk`). Each contestant runs FEW and MANY trials; the difference is what trials cost without the start.
The last states of the first trials must agree.
"""

import json
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack, chdir
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

import perilune

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "benchmarks" / "basilisk"
FEW, MANY = {"basilisk": 4, "here": 40}, {"basilisk": 24, "here": 1040}
AGREEMENT = 0.01  # m, m/s; each plant holds thrust otherwise within a step
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


def fly_here(folder: Path, plant: str, trials: int, workers: int) -> tuple[float, list[list[float]]]:
    """Time (s) of a batch, and the last position and velocity of each trial, frame of the landing site."""
    use, given = PLANTS[plant]
    start = time.perf_counter()
    flown = perilune.batch(
        "lunar_landing",
        FOLDER / "landing.toml",
        trials=trials,
        workers=workers,
        use={"navigation": "ideal_navigation", **use},
        parameters=["ideal.ssv"],
        set=NO_LAGS | given,
        output=folder / "here",
        overwrite=True,
    )
    elapsed = time.perf_counter() - start
    rows = flown.table()
    names = [f"metric.{vector}{axis}" for vector in "rv" for axis in "xyz"]
    return elapsed, np.stack([rows[name].to_numpy() for name in names], axis=1).tolist()


def fly_there(folder: Path, python: str, trials: int, workers: int, *options: str) -> tuple[float, list[list[float]]]:
    """Likewise in Basilisk."""
    command = [python, "-W", "ignore", "-m", "benchmarks.basilisk.monte_carlo", str(folder), str(trials), str(workers)]
    done = subprocess.run([*command, *options], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    document = json.loads(done.stdout.splitlines()[-1])
    return document["seconds"], (np.array(document["states"]) - (0, 0, MOON_RADIUS, 0, 0, 0)).tolist()


def write_draws(folder: Path) -> None:
    """The draws of a campaign as Basilisk's files of initial conditions."""
    (folder / "draws").mkdir()
    for row in pq.read_table(folder / "here" / "draws.parquet").to_pylist():
        document = {}
        for attribute, vector in VECTORS.items():
            elements = [row.get(f"{vector}[{axis}]", 0.0) for axis in (1, 2, 3)]
            centre = MOON_RADIUS if vector == "plant.initial_position" else 0.0
            document[f"craft.{attribute}"] = [[elements[0]], [elements[1]], [elements[2] + centre]]
        (folder / "draws" / f"run{row['trial']}.json").write_text(json.dumps(document))


def main(python: str) -> None:
    print("| contestant | workers | trials a second | farthest from `here` at the end |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary, ExitStack() as stack:
        folder = Path(temporary)
        stack.enter_context(chdir(folder))
        perilune.export(ROOT / "examples" / "basilisk_moon_lander.py")
        _, reference = fly_here(folder, "here", MANY["basilisk"], 1)
        write_draws(folder)
        contestants = {name: ("here", lambda n, w, name=name: fly_here(folder, name, n, w)) for name in PLANTS}
        contestants["here, Basilisk's plant"] = ("basilisk", contestants["here, Basilisk's plant"][1])
        for name, options in (("Basilisk", ()), ("Basilisk without its pause", ("--no-pause",))):
            contestants[name] = (
                "basilisk",
                lambda n, w, options=options: fly_there(folder, python, n, w, *options),
            )
        for name, (size, fly) in contestants.items():
            for workers in (1, 2):
                (few, _), (many, states) = fly(FEW[size], workers), fly(MANY[size], workers)
                rate = (MANY[size] - FEW[size]) / (many - few)
                apart = np.abs(np.array(states)[: len(reference)] - np.array(reference)).max()
                if apart > AGREEMENT:
                    sys.exit(f"{name}: not the same landings: {apart:.3g} m or m/s apart at the end")
                print(f"| {name} | {workers} | {rate:.2f} | {apart:.1e} m, m/s |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
