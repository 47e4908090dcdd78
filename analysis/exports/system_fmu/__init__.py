"""Export of a system as one self-contained FMU of FMI 2.0: the C of its components, and the co-simulation steps."""
