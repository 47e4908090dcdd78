"""One noisy flight of every system, as a digest of its samples: `python -m tests.package.flights`.

`make lowest` and `make newest` compare what it prints with what it prints in `.venv`, which has the lock's packages.
"""

from __future__ import annotations

import hashlib

import numpy as np

import perilune
from perilune.common.paths import SYSTEMS


def digest(system: str, stop_time: float | None = None) -> str:
    """Return the SHA-256 of times and signals of a whole flight, or of one until ``stop_time`` in s."""
    flight = perilune.simulate(system, parameters=["noisy.ssv"], flavour="native", stop_time=stop_time)
    content = hashlib.sha256(np.ascontiguousarray(flight.time).tobytes())
    for name, samples in sorted(flight.signals.items()):
        content.update(name.encode() + b"\0" + np.ascontiguousarray(samples).tobytes())
    return content.hexdigest()


def main() -> None:
    """Print a line for each system."""
    for path in sorted(SYSTEMS.glob("*/SystemStructure.ssd")):
        print(digest(path.parent.name), path.parent.name, flush=True)


if __name__ == "__main__":
    main()
