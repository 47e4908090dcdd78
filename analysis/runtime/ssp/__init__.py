"""What is written: archives and SSP documents, read into plain values, and names in them; no FMU is opened here."""
