"""Writing components and systems: templates, descriptions."""
