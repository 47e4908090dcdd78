"""What ends a phase of flight and starts the next."""
