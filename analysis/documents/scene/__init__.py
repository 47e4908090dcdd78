"""A flight in three dimensions: poses, and what the page stores of a scene."""
