"""Random disturbances with a prescribed spectrum."""
