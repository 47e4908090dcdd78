"""Checks of sampling sensors: samples at the start and at every second row, with held outputs in between."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow

ROWS, EVERY = 25, 2
SAMPLES = (ROWS + 1) // EVERY
SEED, STREAM = 28, 7
SAMPLING = {"sample_period": EVERY * STEP, "seed": SEED, "stream": STREAM}
TIME = STEP * np.arange(ROWS)
COUNTED = ("sample_count", "status", "valid")


def sampled(rows):
    """Return a sensor's inputs at its samples: a sample at t_n has the inputs of the row before."""
    return follow(rows)[::EVERY]


def repeat(samples):
    return np.repeat(samples, EVERY, axis=0)[:ROWS]


def check_sensor(truth, inputs, samples, parameters, tolerance, count=None):
    """Return the check of a sensor with these ``samples`` of its outputs; ``count`` if not all samples count."""
    outputs = {name: repeat(rows) for name, rows in samples.items()}
    outputs["sample_count"] = repeat(1 + np.arange(SAMPLES) if count is None else count)
    return Check(
        truth=truth,
        step=STEP,
        inputs=inputs,
        outputs=outputs,
        tolerances={**dict.fromkeys(samples, tolerance), **dict.fromkeys(COUNTED, (0.0, 0.0))},
        parameters={**SAMPLING, **parameters},
    )


def wave(size, *phases):
    """Return waves, a row per time, an element per phase."""
    return size * np.sin(0.7 * TIME[:, None] + np.array(phases))


def keep(rows, measured):
    """Return outputs at every sample, the last valid one where none is valid, 0 before; and the count."""
    assert 0 < measured.sum() < SAMPLES
    count = np.cumsum(measured)
    return np.concatenate([np.zeros_like(rows[:1]), rows[measured]])[count], count
