"""Samples for the trials of a campaign."""
