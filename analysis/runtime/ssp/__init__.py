"""What is written: archives and SSP documents, read into plain values; no FMU is opened here."""
