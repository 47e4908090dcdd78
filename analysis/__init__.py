"""What runs on components and systems: co-simulation, batches, reports, the command line."""
