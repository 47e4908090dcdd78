"""What `perilune batch` does instead of its trials."""
