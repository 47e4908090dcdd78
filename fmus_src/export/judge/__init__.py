"""Language of kernels: their Python read, typed and checked against the subset that means the same in C."""
