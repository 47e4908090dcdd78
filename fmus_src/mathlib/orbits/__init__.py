"""Flight and attitude on an orbit. Kernel functions."""
