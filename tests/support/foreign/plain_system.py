"""Ramp and gain as written by Perilune, for comparison with the same system as written by other tools."""

import numpy as np

from tests.support.builders import component, connection, document, fly, pack, system

RAMP = component("ramp", "ramp", "output y Real m; output count Integer")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
WIRED = connection("ramp.y", "gain.u")
ROOT = "output out Real m"


def fly_plain(fmus, folder):
    """Simulate the gain's output and the system's output."""
    root = system(RAMP, GAIN, connections=WIRED + connection("gain.y", "out"), declared=ROOT)
    return fly(pack(folder / "plain.ssp", fmus, document(root)))


def same(result, plain):
    """Assert that both are 3 (1 + 2 t) m, at steps of 0.25 s."""
    for name in ("gain.y", "out"):
        np.testing.assert_array_equal(result[name], plain[name])
    assert plain["gain.y"].tolist() == [3.0 * (1.0 + 0.5 * n) for n in range(5)]
