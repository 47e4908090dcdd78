"""A release: archives built twice and compared, the changelog's head, the tag, the size of an installation."""
