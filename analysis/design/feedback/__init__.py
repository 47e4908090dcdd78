"""Modal synthesis beyond gains on state and output: derivatives fed back, disturbances, divisors of zero."""
