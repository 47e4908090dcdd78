"""The mathematics of a control loop, free of FMI: responses, margins, describing functions, limit cycles."""
