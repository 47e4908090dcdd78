"""Templates for new components and systems, and descriptions of existing ones."""
