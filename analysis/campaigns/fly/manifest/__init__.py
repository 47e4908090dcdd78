"""A campaign as files: all that its flights depend on, by content, so that any machine can fly any part of it."""
