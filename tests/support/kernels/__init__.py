"""Kernels good and bad, native instances, and programs in C that drive FMUs."""
