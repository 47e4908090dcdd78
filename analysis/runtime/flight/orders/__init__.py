"""Writers of the calls of a component's FMU as instructions, with one interface for FMI 2.0 and FMI 3.0."""
