"""Systems that are read, checked and prepared for simulation."""
