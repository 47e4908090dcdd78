"""A batch as a document."""
