"""The block diagram of a system: its graph, the layout, the drawing, tables of blocks and connections."""
