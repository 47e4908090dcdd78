"""The same Monte Carlo here and in Basilisk's controller: the same draws, guidance and end."""
