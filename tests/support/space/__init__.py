"""What tests of a spacecraft and of its surroundings share."""
