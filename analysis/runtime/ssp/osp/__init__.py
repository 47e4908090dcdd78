"""Systems as the Open Simulation Platform writes them."""
