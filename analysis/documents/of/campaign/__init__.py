"""Tables and figures that documents of batches and of comparisons share; stored campaigns."""
