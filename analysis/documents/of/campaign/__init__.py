"""Results of campaigns as documents: batches, and the tables that comparisons share with them."""
