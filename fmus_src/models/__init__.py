"""What plants and the models of them in observers and regulators share."""
