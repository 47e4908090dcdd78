"""Evidence stored in an FMU or a system: read, and reproduced by simulation."""
