"""What is asked of a flight besides its system: inputs over time, a limit on the wall clock, what FMUs say."""
