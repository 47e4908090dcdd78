"""Export of a campaign as a simulation task of SSP-LS-Traceability."""
