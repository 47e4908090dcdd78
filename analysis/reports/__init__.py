"""Reports: self-contained HTML pages and figures, the same bytes for the same result."""
