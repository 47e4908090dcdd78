"""Where and when a spacecraft starts: parameters from dates and orbital elements."""
