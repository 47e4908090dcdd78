"""Campaigns in a browser: columns are binned once, counted under filters, and served to this machine only."""
