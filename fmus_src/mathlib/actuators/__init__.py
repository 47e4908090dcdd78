"""Jets, gyros, wheels, pulses and lagged thrust. Kernel functions."""
