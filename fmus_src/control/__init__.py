"""Control laws: from estimate and plan to demanded force and torque."""
