"""Jets, gyros, pulses and thrust. Kernel functions."""
