"""Times of steps of `spacecraft` and of trials of earth_pointing: `python -m benchmarks.spacecraft`.

Needs build_fmus.py. Trials are from the campaign `dispersed` with one worker. Their processor time is the difference
between a long and a short batch.
"""

from __future__ import annotations

import time

import perilune

from .steps import STAGES, SYSTEM, step_times

TRIALS = (1, 5)


def trial_time() -> float:
    """Return the processor time (s) of a trial of the campaign."""
    spent = []
    for trials in (TRIALS[0], *TRIALS):  # the first batch warms up
        begun = time.process_time()
        perilune.batch(SYSTEM, "dispersed", trials=trials, workers=1, engine="threads")
        spent.append(time.process_time() - begun)
    return (spent[-1] - spent[-2]) / (TRIALS[1] - TRIALS[0])


def main() -> None:
    """Print the table of docs/systems/earth_pointing.md."""
    for name, us in step_times().items():
        print(f"| {name} | {us:.2f} | {us / STAGES:.2f} |", flush=True)
    seconds = trial_time()
    print(f"a trial: {seconds:.2f} s of a processor, {1.0 / seconds:.2f} trials a second")


if __name__ == "__main__":
    main()
