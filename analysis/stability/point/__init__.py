"""One operating point and its loops: both routes put together and judged."""
