"""The distributions of a campaign, a class each."""
