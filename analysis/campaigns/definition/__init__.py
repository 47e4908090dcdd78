"""Definition of a batch: file, draws, expressions, metrics, and the plan of all of it."""
