"""Evidence of an FMU or a system: reference trajectories, parameters, a page, hashes, in FMI-LS-REF."""
