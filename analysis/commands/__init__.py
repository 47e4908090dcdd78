"""Command lines that repeat one trial of a campaign or of a study."""
