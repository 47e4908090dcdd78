"""What lies inside a page: columns of numbers, charts of its figures, short paths, scripts and their policy."""
