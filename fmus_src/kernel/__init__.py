"""The language of kernels: its values and its elementary functions."""
