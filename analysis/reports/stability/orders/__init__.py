"""Both orders of FMUs with undeclared dependencies, in words and as a section of the page."""
