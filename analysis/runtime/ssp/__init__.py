"""Files of a system: archives and SSP documents, read into plain values, and names in them. No FMU is opened."""
