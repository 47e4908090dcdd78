"""A system as one FMU of FMI 2.0: its components' C, and the steps between them, in one self-contained file."""
