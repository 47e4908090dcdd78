"""Values before a flight: what is collected of them, and what connections pass on."""
