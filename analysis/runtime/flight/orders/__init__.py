"""Writers of instructions that call a component's FMU, with one interface for FMI 2.0 and FMI 3.0."""
