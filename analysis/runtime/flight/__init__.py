"""What flies a system: instances of FMUs, instructions, memory, faults, results."""
