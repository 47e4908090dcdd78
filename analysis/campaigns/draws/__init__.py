"""Samples of the trials of a campaign."""
