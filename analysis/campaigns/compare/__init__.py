"""Stored batches and their variants side by side, on the same trials."""
