"""Analysis of kernels: Python source is read, typed and checked against the subset with the same meaning in C."""
