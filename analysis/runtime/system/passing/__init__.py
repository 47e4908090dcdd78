"""Values before a simulation: collected settings, and those that connections pass on."""
