"""Array connectors of SSP 2.0, replaced by connectors of their elements, since the runtime only has scalars."""
