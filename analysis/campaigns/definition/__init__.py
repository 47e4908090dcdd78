"""What is asked of a batch: file, draws, expressions, metrics, the plan of it all."""
