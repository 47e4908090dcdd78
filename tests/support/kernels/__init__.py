"""Valid and invalid kernels, native instances, and C programs that drive FMUs."""
