"""Campaigns: specification, draws, execution, trials, verdicts, comparison."""
