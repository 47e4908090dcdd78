"""Native FMUs: compiled through the cache, flown by FMPy, driven under sanitizers."""
