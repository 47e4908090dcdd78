"""Initial parameters of a spacecraft from dates and orbital elements."""
