"""Rare failures: their probability by subset simulation, and the likeliest draws that make them."""
