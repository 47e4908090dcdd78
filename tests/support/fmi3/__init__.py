"""FMUs of FMI 3.0 for tests: the Reference-FMUs, and one that refuses every call that FMI does not allow."""
