"""Start of a spacecraft: parameters from dates and orbital elements."""
