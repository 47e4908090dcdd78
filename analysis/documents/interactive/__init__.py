"""Content of a page for its scripts: columns of numbers, charts of its figures, scripts and their policy."""
