"""Control laws: from the estimate and the plan to demanded force and torque."""
