"""What flies a system: instances of FMUs, the compiled loop, memory, faults, results."""
