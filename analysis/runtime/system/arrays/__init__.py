"""Array connectors of SSP 2.0 as connectors of their elements: what the runtime knows has one value."""
