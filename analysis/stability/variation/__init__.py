"""Margins followed while something varies: the step, a parameter, the trials of a campaign."""
