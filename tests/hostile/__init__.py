"""Hostile input files, a file for each subject, and what commands make of them."""
