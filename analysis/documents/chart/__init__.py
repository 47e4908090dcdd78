"""Charts as data: their ticks and ends, and the SVG that pages have without scripts and on paper."""
