"""Evidence stored in an FMU or a system: its reader, and its reproduction by simulation."""
