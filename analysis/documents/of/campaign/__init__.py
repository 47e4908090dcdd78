"""Tables and figures common to documents of batches and comparisons; document of a stored campaign."""
