"""A block or a system of a user's own to start from, written from templates."""
