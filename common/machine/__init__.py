"""Properties and limits of the machine: cache folder, errors of the operating system, memory."""
