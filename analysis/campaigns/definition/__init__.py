"""Definition of a batch: campaign file, draws, expressions, metrics, and the plan that combines them."""
