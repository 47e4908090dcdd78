"""Charts as data: axes, ticks and ends, and their SVG for paper and for pages without scripts."""
