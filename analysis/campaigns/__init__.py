"""Campaigns: definition, draws, execution, trials, verdicts, comparison."""
