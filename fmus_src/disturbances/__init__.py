"""Random disturbances with a given spectrum."""
