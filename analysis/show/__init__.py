"""Campaigns in a browser: columns binned once, counts under a filter, served to this machine only."""
