"""Jets, gyros, wheels, pulses and thrust. Kernel functions."""
