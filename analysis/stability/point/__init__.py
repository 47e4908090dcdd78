"""One operating point and its loops: linearisation and frequency-response test, combined into verdicts."""
