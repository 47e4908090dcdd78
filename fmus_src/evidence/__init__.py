"""What an FMU or a system is handed on with: reference trajectories, parameters, a page, hashes, in FMI-LS-REF."""
