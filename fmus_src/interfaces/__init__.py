"""What makes blocks swappable: the connectors that all blocks of a slot share."""
