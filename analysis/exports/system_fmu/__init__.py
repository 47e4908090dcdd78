"""Export of a system as one self-contained FMU of FMI 2.0: its components' C code and the co-simulation steps."""
