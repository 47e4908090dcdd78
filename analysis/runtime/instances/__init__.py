"""FMU instances: their libraries, calls, log messages, and whether they can be reset."""
