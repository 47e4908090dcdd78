"""Fuzzing: what others may hand in, changed at random: millions by `make fuzz`, a thousand each in tests."""
