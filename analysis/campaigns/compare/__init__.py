"""Comparison of stored batches and their variants on the same trials."""
