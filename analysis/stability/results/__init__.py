"""Results of a study: plain values, requirements, the document for other programs."""
