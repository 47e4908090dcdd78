"""Studies that choose a campaign's draws themselves, from Python."""
