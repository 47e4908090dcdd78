"""Studies that choose their own draws: rare failures, worst cases, sensitivities."""
