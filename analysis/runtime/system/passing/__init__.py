"""Values before a simulation: collected settings, and values that connections pass on."""
