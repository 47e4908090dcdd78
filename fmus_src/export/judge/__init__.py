"""What a kernel may say: its Python read, typed and judged against the subset that means the same in C."""
