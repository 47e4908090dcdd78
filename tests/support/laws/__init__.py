"""Laws and searches small enough to be known."""
