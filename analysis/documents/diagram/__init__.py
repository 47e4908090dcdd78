"""Block diagram of a system: graph, layout, drawing, tables of blocks and connections."""
