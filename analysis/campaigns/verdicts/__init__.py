"""Statistical evidence from simulations that a required share of them satisfies a requirement."""
