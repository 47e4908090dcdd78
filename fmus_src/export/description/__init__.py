"""XML documents of an FMU, by FMI version."""
