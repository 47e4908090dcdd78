"""One operating point and its loops: linearisation and frequency-response test put together and judged."""
