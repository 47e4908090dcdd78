"""Command lines that repeat one trial of a campaign or a stability study."""
