"""Studies that choose their own samples: rare failures, worst cases, sensitivities."""
