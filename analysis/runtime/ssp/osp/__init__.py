"""Systems in the format of the Open Simulation Platform."""
