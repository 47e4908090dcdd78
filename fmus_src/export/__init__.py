"""From a block to an FMU, and from a system folder to an .ssp."""
