"""Motion and attitude on an orbit. Kernel functions."""
