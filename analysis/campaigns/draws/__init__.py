"""What is drawn for the trials of a campaign."""
