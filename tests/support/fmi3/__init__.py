"""FMUs of FMI 3.0 for tests: the Reference-FMUs, and an FMU that rejects every call that FMI does not allow."""
