"""Statistical evidence from simulations that a required share satisfies a requirement."""
