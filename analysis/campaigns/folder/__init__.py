"""A campaign's folder as analysts read it: lazily, whole or still flying."""
