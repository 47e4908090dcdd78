"""A campaign as a simulation task of SSP-LS-Traceability."""
