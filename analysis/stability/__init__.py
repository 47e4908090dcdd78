"""Linear stability of co-simulated systems: linearise, margins, describing functions, verdicts."""
