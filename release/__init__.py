"""A release: wheel and source distribution, built twice and compared, the changelog's head, the tag. `make release`."""
