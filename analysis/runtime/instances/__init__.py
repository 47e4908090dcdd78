"""FMUs instantiated: their libraries, their calls, what they log, whether they reset."""
