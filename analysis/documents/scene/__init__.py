"""Scene of a simulation in three dimensions: poses, and the data that a page stores."""
