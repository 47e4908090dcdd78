"""Noise of known distribution: a standard normal number of each source for each stream, by hashing the stream."""

import numpy as np
from scipy.special import ndtri

GOLDEN = 0x9E3779B97F4A7C15  # of SplitMix64 (Steele, Lea and Flood 2014), as the two factors of its finaliser


def hashed_normals(streams: np.ndarray, seed: int) -> np.ndarray:
    """Return standard normal numbers (points, sources) of stream numbers (points, sources),
    others for every ``seed``."""
    columns = np.arange(1, streams.shape[1] + 1, dtype=np.uint64)
    offsets = np.uint64(seed * 1_000_003 % 2**64) + columns
    with np.errstate(over="ignore"):
        state = (streams.astype(np.uint64) + offsets * np.uint64(GOLDEN)) * np.uint64(GOLDEN)
        state = (state ^ (state >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        state = (state ^ (state >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        state ^= state >> np.uint64(31)
    return ndtri(((state >> np.uint64(11)).astype(float) + 0.5) * 2.0**-53)
