"""What a study finds: plain values, requirements, the document for other programs."""
