"""Native FMUs: compiled through the cache, simulated by FMPy, driven under sanitizers."""
