"""Systems: files read, checked and prepared for simulation."""
