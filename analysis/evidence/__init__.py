"""Evidence that travels with an FMU or a system, read and reproduced."""
