"""Modal synthesis beyond gains on state and output: derivative feedback, disturbances, divisors of zero."""
