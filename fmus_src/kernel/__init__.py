"""Types, operators and elementary functions of the kernel language."""
