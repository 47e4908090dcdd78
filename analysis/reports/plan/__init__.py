"""The pages of plans: a hover transfer, the bound of a landing."""
