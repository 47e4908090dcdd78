"""Mathematics of a control loop, independent of FMI: responses, margins, describing functions, limit cycles."""
