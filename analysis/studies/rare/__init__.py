"""Rare failures: their probability by subset simulation of draws and noise, and the most probable failed draws."""
