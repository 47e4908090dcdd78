"""Files of a system: archives and SSP documents, read into plain values, and names in them; no FMU is opened here."""
