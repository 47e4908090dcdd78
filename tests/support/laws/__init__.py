"""Small laws and searches with known results."""
