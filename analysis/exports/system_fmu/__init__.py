"""Export of a system as one self-contained FMU of FMI 2.0: the C code of its components and its co-simulation steps."""
