"""Control laws: from the estimate and the plan to the force and torque wanted."""
