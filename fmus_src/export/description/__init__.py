"""XML documents of an FMU, by version of FMI."""
