"""FMU instances: their libraries, calls, log messages, and whether a reset restores them."""
