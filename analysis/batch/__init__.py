"""Campaigns: many trials of a system, with drawn parameters, and what came of them."""
