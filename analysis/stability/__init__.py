"""Linear stability of co-simulated systems: linearisation, margins, describing functions, verdicts."""
