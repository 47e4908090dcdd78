"""Evidence of an FMU or a system in the format FMI-LS-REF: reference trajectories, parameters, a page and hashes."""
