"""Runs of consecutive trials, each flown as a whole, in a file of its own."""
